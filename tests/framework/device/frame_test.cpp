// Frames of a rig: where they are, how they move, and what they do to samples and forces. Oracles: compositions by hand,
// finite differences, and that a turn changes no power.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/device/framed_device.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

Quat turn(double degrees, const Vec3& axis) {
  return Quat(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()));
}

/// A user who walks and turns, a head on it, and a lamp on the tool of the first role.
Rig walkingRig() {
  Rig rig;
  Frame user{.name = "user", .parent = "world", .X_PF = {{1, 0, 0}, turn(90, Vec3::UnitZ())}, .keys = {}};
  user.keys = {{1, {}}, {3, {{0.5, 0.2, 0}, turn(-70, {1, 2, 3})}}, {4, {{0.5, 0, 0}, turn(100, Vec3::UnitX())}}};
  const Frame head{.name = "head", .parent = "user", .X_PF = {{0, 0, 1.6}, turn(30, Vec3::UnitY())}, .keys = {}};
  const Frame lamp{.name = "lamp", .parent = "thumb", .X_PF = {{0, 0.1, 0}, Quat::Identity()}, .keys = {}};
  rig.frames = {head, user, lamp};  // a parent may stand below
  return rig;
}

std::vector<DeviceRole> oneRole() {
  DeviceRole thumb;
  thumb.role = "thumb";
  return {thumb};
}

double difference(const Pose& a, const Pose& b) { return (a.p - b.p).norm() + a.q.angularDistance(b.q); }

TEST(FrameTree, ComposesFromTheWorldDown) {
  const FrameTree tree(walkingRig(), oneRole());
  const Pose X_WU{{1, 0, 0}, turn(90, Vec3::UnitZ())}, X_UH{{0, 0, 1.6}, turn(30, Vec3::UnitY())};
  const Pose at_end = X_WU * Pose{{0.5, 0, 0}, turn(100, Vec3::UnitX())};
  EXPECT_LT(difference(tree.at(tree.find("user"), 0).X_WF, X_WU), 1e-12) << "rests at its first key";
  EXPECT_LT(difference(tree.at(tree.find("head"), 0).X_WF, X_WU * X_UH), 1e-12);
  EXPECT_LT(difference(tree.at(tree.find("head"), 9).X_WF, at_end * X_UH), 1e-12) << "and at its last";
  EXPECT_EQ(tree.find("world"), FrameTree::kWorld);
  EXPECT_LT(difference(tree.at(FrameTree::kWorld, 2).X_WF, {}), 1e-15);
}

// Velocities are the derivatives of the poses: central differences of 10 us, whose error is far below the bound.
TEST(FrameTree, VelocitiesAreThoseOfThePoses) {
  const FrameTree tree(walkingRig(), oneRole());
  constexpr double kStep = 1e-5;
  for (const char* name : {"user", "head"}) {
    for (double time = 0.55; time < 4.5; time += 0.1) {
      const int frame = tree.find(name);
      const FrameMotion now = tree.at(frame, time);
      const Pose before = tree.at(frame, time - kStep).X_WF, after = tree.at(frame, time + kStep).X_WF;
      const Eigen::AngleAxisd turned(after.q * before.q.conjugate());
      EXPECT_LT((now.v_WF - (after.p - before.p) / (2 * kStep)).norm(), 1e-6) << name << time;
      EXPECT_LT((now.w_WF - turned.angle() / (2 * kStep) * turned.axis()).norm(), 1e-6) << name << time;
    }
  }
}

TEST(FrameTree, AFrameOnAToolFollowsIt) {
  FrameTree tree(walkingRig(), oneRole());
  ASSERT_TRUE(tree.carries(0));
  const Pose X_WT{{0.2, 0.3, 0.4}, turn(90, Vec3::UnitX())};
  tree.setTool(0, {X_WT, {1, 0, 0}, {0, 0, 2}});
  const FrameMotion lamp = tree.at(tree.find("lamp"), 0);
  EXPECT_LT(difference(lamp.X_WF, {{0.2, 0.3, 0.5}, X_WT.q}), 1e-12);
  EXPECT_LT((lamp.v_WF - Vec3(1, 0, 0)).norm(), 1e-12) << "0.1 m along the axis of the turn";
}

/// A stylus that reports one sample in its own frame and keeps the last wrench.
class Stylus final : public Device {
 public:
  FingerInput read(const Tick&) noexcept override { return sample; }
  void write(const Wrench& F_H_W, const Tick&) noexcept override { wrench = F_H_W; }
  FingerInput sample{.p_WH = {0.1, 0.2, 0.3}, .v_WH = {1, -2, 3}, .valid = true, .oriented = true, .w_WT = {3, 2, 1}};
  Wrench wrench;
};

// What the hand feels does the same work in its frame as in the world, apart from what moves the frame itself.
TEST(FramedDevice, TurnsSamplesAndWrenchesWithTheSamePower) {
  const auto tree = std::make_shared<FrameTree>(walkingRig(), oneRole());
  const int head = tree->find("head");
  auto made = std::make_unique<Stylus>();
  Stylus& stylus = *made;
  FramedDevice device(std::move(made), tree, head, 0);
  const Wrench F_H_W({0.3, -0.7, 1.1}, {0.01, 0.02, -0.03});
  const RealTimeGuard guard;
  for (std::uint64_t n = 0; n < 4000; n += 250) {
    const Tick tick{n, 1e-3 * static_cast<double>(n), 1e-3};
    const FingerInput sample = device.read(tick);
    device.write(F_H_W, tick);
    const FrameMotion frame = tree->at(head, tick.time);
    EXPECT_LT((sample.p_WH - frame.X_WF * stylus.sample.p_WH).norm(), 1e-12);
    const Vec3 carried = frame.v_WF + frame.w_WF.cross(sample.p_WH - frame.X_WF.p);
    EXPECT_NEAR(F_H_W.f.dot(sample.v_WH - carried), stylus.wrench.f.dot(stylus.sample.v_WH), 1e-12);
    EXPECT_NEAR(F_H_W.t.dot(sample.w_WT - frame.w_WF), stylus.wrench.t.dot(stylus.sample.w_WT), 1e-12);
    EXPECT_NEAR(stylus.wrench.f.norm(), F_H_W.f.norm(), 1e-12);
    EXPECT_LT((tree->at(tree->find("thumb"), 0).X_WF.p - sample.p_WH).norm(), 1e-15);
  }
  if (RealTimeGuard::active()) {
    EXPECT_EQ(guard.violations(), 0) << guard.first();
  }
}

}  // namespace
}  // namespace presa
