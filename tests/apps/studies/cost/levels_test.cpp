// Numbers of renderers with a direction of accuracy: as knobs, in the reference's levels, and the orders that they show.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/finer_knobs.h"
#include "apps/studies/cost/orders.h"
#include "apps/studies/cost/plan.h"
#include "apps/studies/cost/reference_levels.h"
#include "tests/apps/support/support.h"

namespace presa::cost {
namespace {

using Sets = std::vector<std::string>;
using testing::ElementsAre;
using testing::IsEmpty;

const char* const kVoxel = "haptics/pointshell/voxel=";
const char* const kPoints = "haptics/pointshell/max_points=";

Study plannedOf(const std::string& scene, const Sets& knobs, std::string* errors = nullptr) {
  Diagnostics diagnostics;
  Study study = planStudy({.input = test::source("config/scenes/" + scene + ".xml"),
                           .factors = knobs,
                           .out = test::scratch("planned"),
                           .quick = true},
                          diagnostics);
  if (errors != nullptr)
    *errors = diagnostics.text();
  else
    EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return study;
}

// The scene has 20000 points and lets the renderer choose the voxels: only a varied voxel has a finest value to refine.
TEST(Levels, RefineWhatTheManifestSaysFromTheFinestValue) {
  const Study study = plannedOf("stylus_on_bunny", {"voxel=0.002,0.001"});
  ASSERT_EQ(study.reference.size(), 2u);
  const Sets first = setsOfLevel(study, 0, noLimits(study)), last = setsOfLevel(study, 1, noLimits(study));
  EXPECT_THAT(first, testing::IsSupersetOf({kVoxel + std::string("5e-04"), kPoints + std::string("40000")}));
  EXPECT_THAT(last, testing::IsSupersetOf({kVoxel + std::string("0.00025"), kPoints + std::string("80000")}));
  EXPECT_EQ(study.factors.at(0).finer, Direction::kDown);
  const Study other = plannedOf("stylus_on_bunny", {"max_points=100,30000"});
  EXPECT_THAT(setsOfLevel(other, 0, noLimits(other)),
              testing::AllOf(testing::Contains(kPoints + std::string("60000")),
                             testing::Not(testing::Contains(testing::StartsWith(kVoxel)))));
}

TEST(Levels, StayWithinTheBoundsOfTheManifest) {
  const Study study = plannedOf("stylus_on_bunny", {"max_points=1500000"});
  EXPECT_THAT(setsOfLevel(study, 1, noLimits(study)), testing::Contains(kPoints + std::string("4e+06")));
}

TEST(Levels, AreThoseOfTheSceneWithoutSuchKnobs) {
  const Study study = plannedOf("cube", {"dynamics_rate=100,500"});
  EXPECT_THAT(study.finer, IsEmpty());
  std::string errors;
  plannedOf("cube", {"voxel=0.001"}, &errors);
  EXPECT_THAT(errors,
              testing::HasSubstr("error[E816]: knob 'voxel' does nothing in this scene: no renderer of it has one"));
  plannedOf("cube", {"voxle=0.001"}, &errors);
  EXPECT_THAT(errors, testing::HasSubstr("there is no knob 'voxle' (did you mean 'voxel'?)"));
}

Study invented() {
  Study study;
  study.reference = {{"rates/haptic=5000"}, {"rates/haptic=10000"}, {"rates/haptic=20000"}};
  study.finer = {{"v=4", "v=2", "v=1", "v=0.5"}, {"n=10", "n=20", "n=40", "n=80", "n=160"}};
  return study;
}

// A knob that is too fine for the memory keeps a coarser value, the others go on.
TEST(Levels, WithoutRoomKeepOneKnobCoarser) {
  const Study study = invented();
  const auto voxelFits = [&](const FinerLimits& limits) { return limits[0] <= 2; };  // v = 2 and coarser
  EXPECT_THAT(limitsThatRun(study, 1, noLimits(study), voxelFits), ElementsAre(2, 5));
  EXPECT_THAT(setsOfLevel(study, 2, {2, 5}), ElementsAre("rates/haptic=20000", "v=2", "n=160"));
  EXPECT_THAT(keptKnobs(study, 2, {2, 5}), ElementsAre("v=2"));
  EXPECT_THAT(keptKnobs(study, 2, {0, 5}), ElementsAre("v as in the scene"));
  EXPECT_THAT(keptKnobs(study, 0, {2, 5}), IsEmpty()) << "the first level has v = 2 as planned";
  // the second knob's turn comes where the first one does not help; where none does, all go
  EXPECT_THAT(limitsThatRun(study, 1, {4, 5}, [](const FinerLimits& l) { return l[1] <= 3; }), ElementsAre(4, 3));
  EXPECT_THAT(limitsThatRun(study, 1, {4, 5}, [](const FinerLimits&) { return false; }), ElementsAre(0, 0));
}

/// Errors of a method of order p against its own result at `fine`.
std::vector<double> errorsOf(double p, const std::vector<double>& steps, double fine) {
  std::vector<double> errors;
  for (const double step : steps) errors.push_back(3 * (std::pow(step, p) - std::pow(fine, p)));
  return errors;
}

// To half a hundredth, the grid of the fit.
TEST(Orders, AreThoseOfThePower) {
  for (const double p : {0.5, 1.0, 2.0, 4.0})
    for (const double fine : {0.0, 0.08})
      EXPECT_NEAR(fittedOrder({1, 0.5, 0.25}, errorsOf(p, {1, 0.5, 0.25}, fine), fine).value_or(0), p, 0.0051);
}

TEST(Orders, AreNoneWhereErrorsDoNotFall) {
  EXPECT_FALSE(fittedOrder({1, 0.5, 0.25}, {1, 1, 1}, 0));
  EXPECT_FALSE(fittedOrder({1, 0.5, 0.25}, {1, 4, 1}, 0));
  EXPECT_FALSE(fittedOrder({1, 0.5, 0.25}, {0.2, 0.5, 1}, 0));
  EXPECT_FALSE(fittedOrder({1, 0.5}, {1e-12, 1e-13}, 0)) << "rounding";
  EXPECT_FALSE(fittedOrder({1, 0.5}, {4, 1}, 0.2)) << "the second step is too near to the one compared with";
}

}  // namespace
}  // namespace presa::cost
