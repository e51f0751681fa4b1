#include "apps/experiment/simulate/simulation.h"

#include <cstdio>
#include <filesystem>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/file_text.h"
#include "apps/experiment/simulate/power.h"
#include "apps/experiment/simulate/variations.h"
#include "experiments/runner/definition/read.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

/// Writes the plan into the folder: the same command continues it, a different one is refused.
void claimFolder(const StudiesPlan& plan, const Experiment& experiment) {
  const std::string file = plan.out + "/plan.txt", text = planText(plan, experiment);
  std::error_code error;
  fs::create_directories(plan.out, error);
  if (error) refuse(951, plan.out, "the folder cannot be made: " + error.message());
  if (!fs::exists(file)) return writeFileAtomically(file, text);
  if (contentsOf(file) != text)
    refuse(951, plan.out, "holds studies of another experiment, level or seed", "give another --out");
}

/// Runs the studies; an exit status when they are not all complete.
std::optional<int> complete(const StudiesPlan& plan, const Experiment& experiment) {
  claimFolder(plan, experiment);
  const StudiesOutcome outcome = runStudies(plan, sessionsOf(plan, experiment.seed));
  for (const std::string& failure : outcome.failed) std::fprintf(stderr, "presa: error: %s\n", failure.c_str());
  if (outcome.interrupted) {
    std::fprintf(stderr, "stopped; %zu sessions are complete, the same command continues\n",
                 outcome.complete + outcome.found);
    return kExitInterrupted;
  }
  std::printf("%zu sessions complete, %zu of them before, %zu failed\n%s\n", outcome.complete + outcome.found,
              outcome.found, outcome.failed.size(), experiment.model.c_str());
  if (!outcome.failed.empty()) return kExitFault;
  return std::nullopt;
}

/// Writes the rig of each variation and reads it, so that a mistake is found before anything is simulated.
std::vector<Experiment> readVariations(const std::vector<Variation>& variations, const std::string& rig_xml) {
  std::vector<Experiment> experiments;
  for (const Variation& variation : variations) {
    std::error_code error;
    fs::create_directories(variation.plan.out, error);
    if (error) refuse(951, variation.plan.out, "the folder cannot be made: " + error.message());
    writeFileAtomically(variation.plan.rig_file, rigWith(rig_xml, variation));
    auto experiment = readSimulated(variation.plan);
    if (!experiment) return {};
    claimFolder(variation.plan, *experiment);
    experiments.push_back(std::move(*experiment));
  }
  return experiments;
}

/// Simulates all variations; those with a failed session are not compared.
int simulateVariations(const Simulation& wanted, const Experiment& given) {
  const StudiesPlan& plan = wanted.plan;
  const std::vector<Variation> variations = variationsOf(plan, wanted.varied);
  const std::vector<Experiment> experiments = readVariations(variations, given.rig_xml);
  if (experiments.empty()) return kExitBadInput;
  std::vector<Variation> whole;
  for (std::size_t v = 0; v < variations.size(); ++v) {
    std::printf("%s\n", variations[v].name().c_str());
    const auto status = complete(variations[v].plan, experiments[v]);
    if (status == kExitInterrupted) return *status;
    if (!status) whole.push_back(variations[v]);
  }
  if (plan.shard.count > 1) return whole.size() == variations.size() ? kExitOk : kExitFault;
  if (whole.empty() || !whole.front().key.empty()) return kExitFault;  // nothing to compare with
  const int status = reportVariations(plan.out, whole, given);
  return status == kExitOk && whole.size() < variations.size() ? kExitFault : status;
}

}  // namespace

std::string planText(const StudiesPlan& plan, const Experiment& experiment) {
  return "experiment " + experiment.name + "\nseed " + std::to_string(experiment.seed) + "\nlevel " + plan.level +
         "\n" + experiment.resolved_xml + experiment.scene_xml + experiment.rig_xml;
}

std::optional<Experiment> readSimulated(const StudiesPlan& plan) {
  Diagnostics diagnostics;
  auto experiment = readExperiment(plan.experiment_file, plan.rig_file, diagnostics, plan.level);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (experiment && experiment->model.empty())
    refuse(952, plan.experiment_file, "its rig waits for a person",
           "--simulated L0, L1 or L2, or a --rig with simulated devices");
  return experiment;
}

int simulate(const Simulation& wanted) {
  const auto experiment = readSimulated(wanted.plan);
  if (!experiment) return kExitBadInput;
  if (!wanted.varied.empty()) return simulateVariations(wanted, *experiment);
  if (const auto status = complete(wanted.plan, *experiment)) return *status;
  return wanted.plan.shard.count > 1 ? kExitOk : reportPower(wanted.plan, *experiment);
}

}  // namespace presa::experiment
