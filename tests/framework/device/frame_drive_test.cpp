// Frames that their user moves: clutch, zoom and walking of one device. Oracles: the offset of the hand, the scale, the
// conservation of power, and that nothing moves under a force.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/device/driven_device.h"
#include "framework/device/frame_words.h"
#include "framework/device/framed_device.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

constexpr std::uint32_t kClutch = 1U << 1, kFiner = 1U << 2, kCoarser = 1U << 3;
constexpr double kTickLength = 1e-3;

Rig deskRig() {
  Rig rig;
  Frame user{
      .name = "user", .parent = "world", .X_PF = {{1, 2, 0}, Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ()))}, .keys = {}};
  user.moves = Frame::Moves::kFly;
  user.speed = 0.5;
  Frame desk{.name = "desk",
             .parent = "user",
             .X_PF = {{0.3, 0, 0.8}, Quat(Eigen::AngleAxisd(0.4, Vec3::UnitX()))},
             .keys = {}};
  desk.clutch = Frame::Button{1, {}};
  desk.zoom = Frame::Zoom{.min = 0.25, .max = 4, .rate = 8, .in = {2, {}}, .out = {3, {}}};
  rig.frames = {user, desk};
  rig.devices.resize(1);
  rig.devices[0].role = "thumb";
  rig.devices[0].frame = "desk";
  return rig;
}

/// A hand that is where the test says, and keeps the last wrench.
class Hand final : public Device {
 public:
  FingerInput read(const Tick&) noexcept override { return sample; }
  void write(const Wrench& F_H, const Tick&) noexcept override { wrench = F_H; }
  FingerInput sample{.p_WH = {0.1, 0.2, 0.3}, .valid = true, .oriented = true, .w_WT = {3, 2, 1}};
  Wrench wrench;
};

class Desk {
 public:
  explicit Desk(const Rig& rig = deskRig()) : tree_(std::make_shared<FrameTree>(rig, roles())) {
    auto made = std::make_unique<Hand>();
    hand = made.get();
    auto driven = std::make_unique<DrivenDevice>(std::move(made), tree_, 0, DrivenDevice::Slew{1000, 10});
    device_ = std::make_unique<FramedDevice>(std::move(driven), tree_, tree_->find("desk"), 0);
  }
  /// A tick with these buttons, the hand moved by `by`, and this force in the world. Returns the sample in the world.
  FingerInput tick(std::uint32_t buttons = 0, const Vec3& by = Vec3::Zero(), const Vec3& f_W = Vec3::Zero()) {
    hand->sample.buttons = buttons;
    hand->sample.p_WH += by;
    hand->sample.v_WH = by / kTickLength;
    device_->point({.frames = wish}, now_);
    const FingerInput sample = device_->read(now_);
    device_->write({f_W, Vec3::Zero()}, now_);
    ++now_.index;
    now_.time += kTickLength;
    return sample;
  }
  /// The force that the last tick's should have been instead.
  FingerInput readOnly() {
    const FingerInput sample = device_->read(now_);
    ++now_.index;
    now_.time += kTickLength;
    return sample;
  }
  FrameNow now(const std::string& frame) const {
    FrameState state(tree_->frames());
    tree_->tell(now_.time, state);
    return state.frames[frame == "user" ? 0 : 1];
  }
  void write(const Wrench& F_H_W) { device_->write(F_H_W, now_); }
  void doubt(bool doubted) { tree_->doubt(0, doubted); }
  void rearm() { device_->rearm(); }

  Hand* hand;
  FrameWish wish;

 private:
  static std::vector<DeviceRole> roles() {
    std::vector<DeviceRole> one(1);
    one[0].role = "thumb";
    return one;
  }
  std::shared_ptr<FrameTree> tree_;
  std::unique_ptr<FramedDevice> device_;
  Tick now_{0, 0, kTickLength};
};

constexpr double kRoundedOff = 1e-12;  // of some thousand additions of numbers near 1

TEST(FrameDrive, TheClutchHoldsTheFingertipAndMovesItsOriginByWhatTheHandMoved) {
  Desk desk;
  const Vec3 start = desk.tick().p_WH;
  const Vec3 step(1e-4, -2e-4, 5e-5);
  desk.tick(kClutch);
  for (int n = 0; n < 500; ++n) {
    const FingerInput sample = desk.tick(kClutch, step);
    ASSERT_LT((sample.p_WH - start).norm(), kRoundedOff);
    ASSERT_LT(sample.v_WH.norm(), kRoundedOff) << "and its velocity says so";
  }
  EXPECT_NE(desk.now("desk").doing & kFrameClutched, 0U);
  const Quat q_WD = desk.now("desk").X_WF.q;
  const FingerInput back = desk.tick(0, -500 * step);
  EXPECT_LT((back.p_WH - (start - q_WD * (500 * step))).norm(), kRoundedOff);
}

TEST(FrameDrive, AtTheScaleSAMillimetreOfTheHandIsSMillimetres) {
  for (const auto& [button, bound] : {std::pair{kFiner, 0.25}, {kCoarser, 4.0}}) {
    Desk desk;
    const Vec3 start = desk.tick().p_WH;
    double before = 1;
    for (int n = 0; n < 300; ++n) {
      const FingerInput sample = desk.tick(button);
      ASSERT_LT((sample.p_WH - start).norm(), kRoundedOff) << "the zoom is about the hand";
      const double scale = desk.now("desk").zoom;
      const double change = button == kCoarser ? scale / before : before / scale;
      ASSERT_LE(change, std::pow(8, kTickLength) * (1 + kRoundedOff)) << "continuous";
      before = scale;
    }
    for (int n = 0; n < 1000; ++n) desk.tick(button);
    EXPECT_EQ(desk.now("desk").zoom, bound);
    const Vec3 moved = desk.tick(0, {1e-3, 0, 0}).p_WH - start;
    EXPECT_NEAR(moved.norm(), bound * 1e-3, kRoundedOff);
  }
}

// Power in the hand is power in the world at every scale: the force is scaled as the lengths are, the torque is not.
TEST(FrameDrive, AForceDoesTheSameWorkInTheHandAsInTheWorld) {
  Desk desk;
  for (int n = 0; n < 200; ++n) desk.tick(kCoarser, {1e-4, 0, 0});
  const Vec3 f_W(0.3, -0.7, 1.1), by(2e-4, -1e-4, 3e-4);
  const double scale = desk.now("desk").zoom;
  ASSERT_GT(scale, 1.4);
  desk.tick();
  for (int n = 0; n < 50; ++n) {
    const FingerInput sample = desk.tick(kCoarser | kClutch, by, f_W);
    if (n < 5) continue;  // the first one may answer a step of the frame, and comes back within the slew limit
    EXPECT_EQ(desk.now("desk").zoom, scale) << "and the frame waits";
    EXPECT_NEAR(f_W.dot(sample.v_WH), desk.hand->wrench.f.dot(desk.hand->sample.v_WH), kRoundedOff);
    EXPECT_NEAR(desk.hand->wrench.f.norm(), scale * f_W.norm(), kRoundedOff);
  }
}

// Walking in free space adds its velocity to that of the hand, here at full speed along the user's x.
TEST(FrameDrive, WalkingAddsItsVelocity) {
  Desk desk;
  desk.wish.walk = {1, 0, 0};
  for (int n = 0; n < 250; ++n) desk.tick();  // the speed is reached after 0.2 s
  const Vec3 v_W = 0.5 * (Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ())) * Vec3::UnitX());
  Vec3 before = desk.tick().p_WH;
  for (int n = 0; n < 500; ++n) {
    const FingerInput sample = desk.tick();
    ASSERT_LT((sample.v_WH - v_W).norm(), kRoundedOff);
    ASSERT_LT((sample.p_WH - before - kTickLength * v_W).norm(), kRoundedOff);
    before = sample.p_WH;
  }
  EXPECT_EQ(desk.now("user").uses, 1U);
  EXPECT_EQ(desk.now("user").refusals, 0U);
}

// Velocities are the derivatives of the positions while everything moves at once. A step of a tick is exact to the second
// order in it: accelerations here are below 20 m/s^2, so that the mean velocity differs by less than 20 mm/s.
TEST(FrameDrive, VelocitiesAreThoseOfThePositions) {
  Desk desk;
  desk.wish = {.walk = {0.5, -1, 0.3}, .turn = 1};
  Vec3 before = desk.tick().p_WH;
  for (int n = 0; n < 400; ++n) {
    const FingerInput sample = desk.tick(n < 200 ? kCoarser : 0U, {3e-4, 1e-4, -2e-4});
    EXPECT_LT(((sample.p_WH - before) / kTickLength - sample.v_WH).norm(), 0.02) << n;
    before = sample.p_WH;
  }
}

// A step of the frame that meets a body: its force is withheld, the step is taken back, and what the hand then gets of its
// own comes within the slew limit.
TEST(FrameDrive, AStepThatMeetsABodyIsTakenBack) {
  Desk desk;
  desk.wish.walk = {1, 0, 0};
  for (int n = 0; n < 300; ++n) desk.tick();
  const Vec3 free = desk.tick().p_WH, f_W(-0.9, 0, 0);
  const FingerInput met = desk.tick(0, Vec3::Zero(), f_W);
  EXPECT_GT((met.p_WH - free).norm(), 4e-4);
  EXPECT_TRUE(desk.hand->wrench.f.isZero()) << "the step of the frame did it, not the hand";
  const FingerInput back = desk.tick(0, Vec3::Zero(), 2 * f_W);
  EXPECT_LT((back.p_WH - free).norm(), kRoundedOff);
  EXPECT_LT(back.v_WH.norm(), kRoundedOff);
  EXPECT_NEAR(desk.hand->wrench.f.norm(), 1, kRoundedOff) << "1000 N/s for a tick, of 1.8 N";
  desk.tick(0, Vec3::Zero(), 2 * f_W);
  EXPECT_NEAR(desk.hand->wrench.f.norm(), 1.8, kRoundedOff);
  EXPECT_EQ(frameSentence(deskRig().frames[0], desk.now("user")), "'user' waits until no finger in it feels a force.");
  for (int n = 0; n < 300; ++n) desk.tick(0, Vec3::Zero(), f_W);
  EXPECT_LT((desk.tick(0, Vec3::Zero(), f_W).p_WH - free).norm(), kRoundedOff) << "it rests under the force";
  for (int n = 0; n < 300; ++n) desk.tick();
  EXPECT_GT((desk.tick().p_WH - free).norm(), 0.01) << "and goes on without";
  EXPECT_EQ(desk.now("user").uses, 1U);
  EXPECT_EQ(desk.now("user").refusals, 1U);
}

// The output stage is silent after a fault, with the finger in a body: the frame would carry it deeper, and the next
// re-arm would push the hand out.
TEST(FrameDrive, AFrameRestsWhileAForceOfZeroSaysNothing) {
  Desk desk;
  desk.wish.walk = {1, 0, 0};
  for (int n = 0; n < 300; ++n) desk.tick();
  desk.doubt(true);
  desk.tick();
  const Vec3 there = desk.tick().p_WH;
  for (int n = 0; n < 300; ++n) EXPECT_LT((desk.tick().p_WH - there).norm(), kRoundedOff);
  desk.doubt(false);
  for (int n = 0; n < 500; ++n) desk.tick();
  EXPECT_GT((desk.tick().p_WH - there).norm(), 0.01);
}

// A sample that is no number, or a kilometre away, while clutch and zoom are on: it would stay in the frame's place.
TEST(FrameDrive, AnImpossibleSampleMovesNoFrame) {
  for (const double wrong : {static_cast<double>(NAN), 1000.0}) {
    Desk desk;
    for (int n = 0; n < 100; ++n) desk.tick();
    const Vec3 there = desk.tick().p_WH, hand = desk.hand->sample.p_WH;
    desk.hand->sample.p_WH.x() = wrong;
    for (int n = 0; n < 5; ++n) desk.tick(kClutch | kCoarser);
    desk.hand->sample.p_WH = hand;
    desk.rearm();
    for (int n = 0; n < 5; ++n) desk.tick();
    EXPECT_LT((desk.tick().p_WH - there).norm(), kRoundedOff) << wrong;
    for (int n = 0; n < 300; ++n) desk.tick();  // it rests for 0.2 s after a step that it took back
    const Vec3 before = desk.tick(kClutch).p_WH;
    EXPECT_LT((desk.tick(kClutch, {0.001, 0, 0}).p_WH - before).norm(), kRoundedOff) << "the clutch works again";
  }
}

// Ticks that are caught up are not written: nobody knows whether a step was free, so the frame takes no second one.
TEST(FrameDrive, AFrameTakesNoStepWhileTheLastOneIsUnanswered) {
  Desk desk;
  desk.wish.walk = {1, 0, 0};
  for (int n = 0; n < 300; ++n) desk.tick();
  const Vec3 first = desk.readOnly().p_WH;
  for (int n = 0; n < 20; ++n) EXPECT_LT((desk.readOnly().p_WH - first).norm(), kRoundedOff);
}

TEST(FrameDrive, SaysWhatIsOn) {
  Desk desk;
  const Frame frame = deskRig().frames[1];
  desk.tick();
  EXPECT_EQ(frameSentence(frame, desk.now("desk")), "");
  desk.tick(kClutch);
  EXPECT_EQ(frameSentence(frame, desk.now("desk")), "Clutch: 'desk' slides under the hand.");
  for (int n = 0; n < 2000; ++n) desk.tick(kCoarser);
  desk.tick();
  EXPECT_EQ(frameSentence(frame, desk.now("desk")), "Zoom: 1 mm of the hand is 4.00 mm in the scene.");
  EXPECT_EQ(frameSummary(frame, desk.now("desk")),
            "frame 'desk': moved, clutched or zoomed 2 times, 0 of them held up by a force");
}

TEST(FrameDrive, NothingOfItAllocatesOrLocks) {
  Desk desk;
  desk.wish = {.walk = {1, 0.5, 0}, .turn = 0.5};
  const RealTimeGuard guard;
  for (int n = 0; n < 1000; ++n)
    desk.tick(n % 3 == 0 ? kClutch : kCoarser, {1e-5, 0, 0}, n % 100 < 5 ? Vec3(0.1, 0, 0) : Vec3::Zero());
  if (RealTimeGuard::active()) {
    EXPECT_EQ(guard.violations(), 0) << guard.first();
  }
}

}  // namespace
}  // namespace presa
