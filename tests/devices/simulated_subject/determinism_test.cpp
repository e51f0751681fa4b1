// For a reproducible dataset, equal seed, subject and trial must give equal bits; to run in the haptic tick, the model
// must not call the system.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/devices/simulated_subject/study.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa::subject {
namespace {

Trial someTrial() {
  return {.cube = {.mass = 0.2, .mu_s = 0.4, .mu_d = 0.3, .stiffness = 1000},
          .seed = 5,
          .subject = 2,
          .trial = 17,
          .resolution = drawResolution(5, 2, 17)};
}

/// Grip and height of the cube at every tick.
std::vector<double> course(const Trial& trial) {
  StandAlone world(Population(Level::kL1).draw(trial.seed, trial.subject), trial);
  std::vector<double> values;
  while (world.step()) values.insert(values.end(), {world.meanNormal(), world.cubeHeight()});
  return values;
}

TEST(Determinism, TheSameTrialGivesTheSameBits) {
  const std::vector<double> first = course(someTrial()), again = course(someTrial());
  ASSERT_EQ(first.size(), again.size());
  EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(double)), 0);
}

TEST(Determinism, SeedSubjectAndTrialEachMatter) {
  const std::vector<double> reference = course(someTrial());
  for (std::uint64_t Trial::*part : {&Trial::seed, &Trial::subject, &Trial::trial}) {
    Trial other = someTrial();
    ++(other.*part);
    EXPECT_NE(course(other), reference);
  }
}

TEST(Determinism, AStepAsksTheSystemForNothing) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  StandAlone world(Population(Level::kL2).draw(5, 2), someTrial());
  {
    RealTimeGuard guard;
    while (world.step()) {
    }
    EXPECT_EQ(guard.violations(), 0) << guard.first();
  }
  EXPECT_TRUE(world.result().completed);
}

}  // namespace
}  // namespace presa::subject
