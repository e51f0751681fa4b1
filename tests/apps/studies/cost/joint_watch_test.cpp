// A hinge that is pulled open and tilted by known amounts.
#include "apps/studies/cost/joint_watch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/studies/cost/metrics.h"

namespace presa::cost {
namespace {

Scene door() {
  Scene scene;
  scene.bodies.resize(1);
  Joint joint;
  joint.type = JointType::kHinge;
  joint.body = 0;
  joint.p_BJ = {-0.1, 0, 0};
  joint.axes.resize(1);
  scene.joints.push_back(joint);
  return scene;
}

/// A step of 5 ms to this pose of the door, turned about its hinge, tilted about x and moved [m].
ObjectState doorAt(double end, double turn, double tilt, const Vec3& moved) {
  const Quat q = Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(tilt, Vec3::UnitX()));
  ObjectState state;
  state.time_begin = end - 0.005;
  state.time_end = end;
  state.bodies.resize(1);
  const Vec3 p_BJ(-0.1, 0, 0);
  state.bodies[0].X_WB_end = {p_BJ + moved - q * p_BJ, q};
  return state;
}

TEST(JointWatch, TakesTheWidestOpeningOfTheComparedWindow) {
  const Scene scene = door();
  Evidence evidence;
  evidence.compared_from = 0.1, evidence.compared_to = 1;
  JointWatch watch(scene, evidence);
  watch.observe(doorAt(0.05, 0, 0.1, {0.01, 0, 0}));  // before
  watch.observe(doorAt(0.5, 1.2, 0, {0.003, 0, 0.004}));
  watch.observe(doorAt(0.6, -0.4, 0.02, {0, 1e-4, 0}));
  watch.observe(doorAt(1.5, 0, 0.1, {0.01, 0, 0}));  // after
  watch.finish(evidence);
  EXPECT_NEAR(evidence.joint_gap.value(), 5e-3, 1e-12);
  EXPECT_NEAR(evidence.joint_tilt.value(), 0.02, 1e-9);
  const Metric* gap = findMetric("joint_gap");
  ASSERT_NE(gap, nullptr);
  EXPECT_TRUE(gap->absolute);
  EXPECT_NEAR(gap->error(evidence, {}).value(), 5, 1e-9);                               // [mm]
  EXPECT_NEAR(findMetric("joint_tilt")->error(evidence, {}).value(), 1.1459156, 1e-6);  // 0.02 rad in degrees
}

TEST(JointWatch, SaysNothingOfASceneWithoutJoints) {
  Scene scene = door();
  scene.joints.clear();
  Evidence evidence;
  evidence.compared_to = 1;
  JointWatch watch(scene, evidence);
  watch.observe(doorAt(0.5, 0, 0.1, {0.01, 0, 0}));
  watch.finish(evidence);
  EXPECT_FALSE(evidence.joint_gap);
  EXPECT_FALSE(findMetric("joint_gap")->error(evidence, {}));
}

}  // namespace
}  // namespace presa::cost
