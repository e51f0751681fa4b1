#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/analysis/analyse.h"
#include "tests/apps/experiment/synthetic_dataset.h"

namespace presa::experiment::analysis {

/// The design of the grip study with the given <analysis>.
inline std::string gripStudy(const std::string& analysis) {
  return R"(<experiment version="1.0" name="grip" scene="scene.xml" title="Grip &amp; slip">
  <factor name="mass"><column name="mass" unit="kg"/><level values="0.1"/><level values="0.2"/><level values="0.4"/></factor>
  <factor name="friction"><column name="mu_s"/><column name="mu_d"/>
    <level values="0.4 0.3"/><level values="0.8 0.6"/><level values="1.2 1.1"/></factor>
  <factor name="stiffness"><column name="stiffness" unit="N/m"/><level values="500"/><level values="1000"/><level values="2000"/></factor>
  <design repeats="2" practice="2"/>
  <phase name="hold" seconds="10"/>
  <measure name="F_grip" unit="N" value="1"/> <measure name="F_slip" unit="N" value="1"/>
  <analysis>)" +
         analysis + "</analysis></experiment>";
}

inline double levelOf(const Experiment& experiment, const PlannedTrial& trial, const char* name) {
  return std::stod(experiment.valueOf(name, trial.condition));
}

/// The slip force, computed by two equivalent formulas so that equal levels differ in their last bits.
inline double slipForceOf(const Experiment& experiment, const PlannedTrial& trial) {
  const double m = levelOf(experiment, trial, "mass"), mu = levelOf(experiment, trial, "mu_s");
  return trial.number % 2 == 0 ? m * 9.81 / (2 * mu) : m / mu * 0.5 * 9.81;
}

/// Trials with grip = slip force times a factor of the trial.
inline SyntheticDataset::Make gripping(std::function<double(const Experiment&, const PlannedTrial&)> factor) {
  return [factor = std::move(factor)](const Experiment& experiment, const PlannedTrial& trial) {
    const double slip = slipForceOf(experiment, trial);
    return SyntheticDataset::Made{{{"F_grip", slip * factor(experiment, trial)}, {"F_slip", slip}}};
  };
}

class GripStudyTest : public testing::Test {
 protected:
  Result analysed(const std::string& analysis, const SyntheticDataset::Make& make, int subjects = 3) {
    SyntheticDataset dataset(scratch.file("data"), gripStudy(analysis));
    for (int subject = 1; subject <= subjects; ++subject) dataset.addSession(subject, make);
    return analyse({dataset.folder(), ""}, [](auto...) { return true; });
  }
  ScratchFolder scratch;
};

}  // namespace presa::experiment::analysis
