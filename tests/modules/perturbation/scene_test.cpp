// From the command line: the shipped scene, and the shipped cube with force perturbation, from XML alone.
#include <gtest/gtest.h>

#include "tests/apps/support/support.h"
#include "tests/support/lockstep_run.h"

namespace presa {
namespace {

using test::LockstepRun, test::Outcome;

/// `presa VERB` for the shipped cube with the element in its rubber, which stands in line 8.
Outcome cubeWith(const std::string& verb, const std::string& attributes, const std::string& more = {}) {
  const std::string scene = test::cubeWith("perturbed.xml", [&](std::string& xml) {
    xml.insert(xml.find("<friction "), "<perturbation " + attributes + "/>");
  });
  return test::withTestPlugins(verb, scene, more);
}

TEST(SceneWithPerturbation, LoadsItOnlyWhereAMaterialHasIt) {
  const Outcome plain = test::presa("explain " + test::source("config/scenes/texture_sine.xml"));
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_EQ(plain.out.find("presa_perturbation.so"), std::string::npos) << plain.out;
  const Outcome perturbed = test::presa("explain " + test::source("config/scenes/perturbation.xml"));
  EXPECT_EQ(perturbed.status, 0) << perturbed.err;
  EXPECT_NE(perturbed.out.find("presa_perturbation.so"), std::string::npos) << perturbed.out;
  EXPECT_NE(perturbed.out.find("force perturbation: sine of 0.2 mm, wavelength 4 mm, gain 1"), std::string::npos)
      << perturbed.out;
}

TEST(SceneWithPerturbation, IsStrokedToTheEndOfTheScript) {
  for (const std::string form : {"conservative", "printed"}) {
    const LockstepRun run(test::source("config/scenes/perturbation.xml"), {"material/metal/perturbation/form=" + form});
    EXPECT_TRUE(run.faults().empty()) << run.faults().front();
    EXPECT_GT(run.maxNormalForce("index"), 1) << form;
  }
}

TEST(BadPerturbation, IsRefusedWithItsPlaceBeforeAnythingMoves) {
  const std::string sine = R"(shape="sine" amplitude="0.0001" wavelength="0.002" )";
  for (const auto& [attributes, expected] :
       {std::pair(sine + R"(form="exact")", "no form 'exact'; there are conservative and printed"),
        {R"(shape="sinus" amplitude="0.0001" wavelength="0.002")", "no shape 'sinus'"},
        {R"(shape="sine" amplitude="0.0002" wavelength="0.001")", "its slope reaches 1.25664, above 1"}}) {
    const Outcome outcome = cubeWith("run", attributes, " --lockstep");
    EXPECT_EQ(outcome.status, 2) << attributes;
    EXPECT_NE(outcome.err.find("perturbed.xml:8:80: error[E596]"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
  }
  for (const std::string& attributes : {sine + R"(gain="0.5")", sine + R"(gain="-1")", sine + R"(gain="30")",
                                        std::string(R"(shape="sine" wavelength="0.002")")}) {
    const Outcome outcome = cubeWith("check", attributes);
    EXPECT_EQ(outcome.status, 2) << attributes;
    EXPECT_NE(outcome.err.find("perturbed.xml:8:"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace presa
