// Frames of a rig: where they are, how they move, and what they do to samples and forces. Oracles: compositions by hand,
// finite differences, and that a turn changes no power.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/device/frame_words.h"
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

/// A lamp on the tool of a stylus whose tracker may fail, and a device that rests in the lamp's frame.
class LampOnTool {
 public:
  LampOnTool() : tree_(std::make_shared<FrameTree>(walkingRig(), oneRole())) {
    auto made = std::make_unique<Stylus>();
    stylus = made.get();
    stylus->sample.v_WH.setZero(), stylus->sample.w_WT.setZero();
    tool_ = std::make_unique<FramedDevice>(std::move(made), tree_, FrameTree::kWorld, 0);
    rider_ = std::make_unique<FramedDevice>(std::make_unique<Stylus>(), tree_, tree_->find("lamp"), 1);
  }
  /// Ticks of 1 ms with the stylus where it is. Returns the longest step of the lamp's origin [m].
  double ticks(int count) {
    double longest = 0;
    for (int n = 0; n < count; ++n) {
      const Vec3 before = lamp().X_WF.p;
      tool_->read(now_);
      rider = rider_->read(now_);
      if (n > 0 || known_) longest = std::max(longest, (lamp().X_WF.p - before).norm());
      known_ = true;
      ++now_.index;
      now_.time = 1e-3 * static_cast<double>(now_.index);
    }
    return longest;
  }
  FrameMotion lamp() const { return tree_->at(tree_->find("lamp"), now_.time); }
  FrameNow told() const {
    FrameState state(tree_->frames());
    tree_->tell(now_.time, state);
    return state.frames[2];
  }
  std::string says() const { return frameSentence(walkingRig().frames[2], told()); }

  Stylus* stylus;
  FingerInput rider;

 private:
  static std::vector<DeviceRole> oneRole() {
    std::vector<DeviceRole> two(2);
    two[0].role = "thumb", two[1].role = "rider";
    return two;
  }
  std::shared_ptr<FrameTree> tree_;
  std::unique_ptr<FramedDevice> tool_, rider_;
  Tick now_{0, 0, 1e-3};
  bool known_ = false;
};

// The peak speed of a minimum-jerk movement over d in T is 1.875 d / T. The tool neither turned nor moves, so that the
// lamp's step is that of the fading offset; a tick of it is at most its peak speed times a millisecond.
TEST(ToolWatch, AFrameFreezesWhileItsToolIsLostAndReturnsWithoutAJump) {
  LampOnTool desk;
  desk.ticks(100);
  desk.stylus->sample.valid = false;
  const Vec3 way(0.4, -0.3, 0);
  desk.stylus->sample.p_WH += way;
  EXPECT_EQ(desk.ticks(50), 0);
  EXPECT_EQ(desk.says(), "") << "a tracker that blinks is no news";
  EXPECT_EQ(desk.ticks(1000), 0);
  EXPECT_TRUE(desk.lamp().v_WF.isZero());
  EXPECT_TRUE(desk.rider.valid) << "its device works on";
  EXPECT_EQ(desk.says(), "'lamp' stands still: 'thumb', which carries it, is not tracked.");
  desk.stylus->sample.valid = true;
  const double bound = 1.875 * way.norm() / PoseReturn::kTime * 1e-3, longest = desk.ticks(400);
  EXPECT_LE(longest, bound * (1 + 1e-9));
  EXPECT_GE(longest, 0.99 * bound) << "the peak is within these ticks";
  EXPECT_EQ(desk.says(), "'lamp' returns to 'thumb', which is tracked again.");
  EXPECT_LE(desk.ticks(500), bound * (1 + 1e-9));
  EXPECT_EQ(desk.lamp().X_WF.p, desk.stylus->sample.p_WH + Vec3(0, 0.1, 0)) << "to the bit what is measured";
  EXPECT_EQ(desk.says(), "");
  EXPECT_EQ(desk.told().losses, 1U);
  EXPECT_EQ(frameSummary(walkingRig().frames[2], desk.told()),
            "frame 'lamp': 'thumb', which carries it, was lost 1 time");
}

// While it returns, what a frame says of its velocity is what its pose does; a tick of 1 ms at accelerations below
// 40 m/s^2 and 90 rad/s^2 is exact to 1e-3 of either in a tick.
TEST(ToolWatch, VelocitiesOfTheReturnAreThoseOfThePoses) {
  LampOnTool desk;
  desk.ticks(10);
  desk.stylus->sample.valid = false;
  desk.ticks(200);
  desk.stylus->sample.valid = true;
  desk.stylus->sample.p_WH += Vec3(0.2, 0.5, -0.1);
  desk.stylus->sample.q_WT = turn(60, {1, 2, 0.5});
  desk.stylus->sample.w_WT = {0, 0, 1};
  desk.stylus->sample.v_WH = {0.3, 0, 0};
  for (int n = 0; n < 900; ++n) {
    const FrameMotion last = desk.lamp();
    desk.ticks(1);
    const FrameMotion now = desk.lamp();
    const Eigen::AngleAxisd turned(now.X_WF.q * last.X_WF.q.conjugate());
    if (n > 0) {
      EXPECT_LT((0.5 * (now.v_WF + last.v_WF) - (now.X_WF.p - last.X_WF.p) / 1e-3).norm(), 2e-3) << n;
      EXPECT_LT((0.5 * (now.w_WF + last.w_WF) - turned.angle() / 1e-3 * turned.axis()).norm(), 2e-3) << n;
    }
    desk.stylus->sample.p_WH += 1e-3 * desk.stylus->sample.v_WH;
    desk.stylus->sample.q_WT = (Quat(Eigen::AngleAxisd(1e-3, Vec3::UnitZ())) * desk.stylus->sample.q_WT).normalized();
  }
}

// Samples that are no pose count as none, and one that is a kilometre away moves the frame by 1.875 of it at most.
TEST(ToolWatch, ImpossibleSamplesMakeNoJump) {
  for (const double wrong : {static_cast<double>(NAN), 1000.0}) {
    LampOnTool desk;
    desk.ticks(100);
    const Vec3 there = desk.lamp().X_WF.p;
    const double right = std::exchange(desk.stylus->sample.p_WH.x(), wrong);
    EXPECT_LT(desk.ticks(1), 1e-9);
    desk.stylus->sample.p_WH.x() = right;
    EXPECT_LT(desk.ticks(900), 1e-9) << wrong;
    EXPECT_LT((desk.lamp().X_WF.p - there).norm(), 1e-12);
    EXPECT_EQ(desk.told().losses, 0U);
  }
}

// Nobody knows where a device is that stands on a tool which has not been seen yet: it has no sample before.
TEST(ToolWatch, ADeviceWaitsForTheFirstSampleOfItsTool) {
  LampOnTool desk;
  desk.stylus->sample.valid = false;
  desk.ticks(10);
  EXPECT_FALSE(desk.rider.valid);
  desk.stylus->sample.valid = true;
  desk.ticks(1);
  EXPECT_TRUE(desk.rider.valid);
  EXPECT_LT((desk.lamp().X_WF.p - desk.stylus->sample.p_WH - Vec3(0, 0.1, 0)).norm(), 1e-12) << "there at once";
}

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
