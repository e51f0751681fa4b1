// The shipped scenes of the friction laws: each loads its own law and no other, and runs to its end.
#include <gtest/gtest.h>

#include "tests/apps/support/support.h"

namespace presa::law_scenes {
namespace {

class LawScene : public testing::TestWithParam<const char*> {};

TEST_P(LawScene, LoadsItsLawAloneAndRunsToItsEnd) {
  const std::string law = GetParam(), scene = test::source("config/scenes/friction_" + law + ".xml");
  const test::Outcome explained = test::presa("explain " + scene);
  ASSERT_EQ(explained.status, 0) << explained.err;
  EXPECT_NE(explained.out.find("friction: friction_" + law + "\n"), std::string::npos) << explained.out;
  for (const std::string other : {"cone", "viscous", "stribeck", "dahl", "lugre", "membrane", "anisotropic"}) {
    EXPECT_EQ(explained.out.find("presa_friction_" + other + ".so") != std::string::npos, other == law) << other;
  }
  const test::Outcome run = test::presa("run " + scene + " --lockstep");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("6.000 s simulated"), std::string::npos) << run.out;
}

INSTANTIATE_TEST_SUITE_P(Shipped, LawScene,
                         testing::Values("cone", "viscous", "stribeck", "dahl", "lugre", "membrane", "anisotropic"),
                         [](const auto& law) { return std::string(law.param); });

TEST(LawScene, ErrorsNameWhatIsAllowed) {
  const auto boardWith = [](const std::string& law) {
    return test::presa("run " + test::source("config/scenes/friction_cone.xml") + " --lockstep --for 0.1 --set " +
                       "material/wood/friction/" + law);
  };
  const test::Outcome slow = boardWith("stribeck/speed=0");
  EXPECT_EQ(slow.status, 2) << slow.out;
  EXPECT_NE(slow.err.find("error[E"), std::string::npos) << slow.err;
  const test::Outcome no_grain =
      boardWith("anisotropic/grain='0 0 0' --set material/wood/friction/anisotropic/across=2");
  EXPECT_EQ(no_grain.status, 2) << no_grain.out;
  EXPECT_NE(no_grain.err.find("grain must not be 0 0 0"), std::string::npos) << no_grain.err;
}

}  // namespace
}  // namespace presa::law_scenes
