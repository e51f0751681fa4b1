#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "framework/device/transport_watch.h"

// The watch in front of every device in every test: each of its checks is violated on purpose.
namespace presa {
namespace {

class Port final : public Device {
 public:
  FingerInput read(const Tick&) noexcept override { return input; }
  void write(const Wrench&, const Tick&) noexcept override {}
  FingerInput input{.valid = true};
};

constexpr DeviceRating kRating{};  // 5 N, 1 N/ms

class TransportWatchTest : public testing::Test {
 protected:
  void SetUp() override {
    ::setenv("PRESA_WATCH_TRANSPORT", "1", 1);
    auto port = std::make_unique<Port>();
    port_ = port.get();
    device_ = watched(std::move(port), limits(), rating());
    EXPECT_NE(device_.get(), port_);
  }
  void tick(double force) {
    device_->read(tick_);
    device_->write(Vec3(force, 0, 0), tick_);
    ++tick_.index;
    tick_.time += tick_.period;
  }
  virtual const DeviceRating& rating() const { return kRating; }
  virtual OutputLimits limits() const { return {.force = 2, .force_rate = 1000}; }
  Port* port_ = nullptr;
  std::unique_ptr<Device> device_;
  Tick tick_{0, 0, 1e-3};
};

TEST_F(TransportWatchTest, WhatKeepsThePromisesPasses) {
  for (const double force : {0.0, 1.0, 2.0, 1.0, 0.0, -1.0}) tick(force);
}
TEST_F(TransportWatchTest, NotFinite) {
  EXPECT_DEATH(tick(std::numeric_limits<double>::quiet_NaN()), "the force is not finite");
}
// In any component: std::hypot(0, NaN, 0) is 0 in libstdc++ 12.
TEST_F(TransportWatchTest, NotFiniteInAnyComponent) {
  for (int i = 0; i < 3; ++i) {
    Vec3 force = Vec3::Zero();
    force[i] = std::numeric_limits<double>::quiet_NaN();
    device_->read(tick_);
    EXPECT_DEATH(device_->write(force, tick_), "the force is not finite");
  }
}
TEST_F(TransportWatchTest, AboveTheLimit) {
  tick(1);
  tick(2);
  EXPECT_DEATH(tick(2.0001), "the force is above the limit");
}
TEST_F(TransportWatchTest, TooFast) { EXPECT_DEATH(tick(1.0001), "changed faster than the slew limit"); }
TEST_F(TransportWatchTest, BeforeTheFirstSample) {
  port_->input.valid = false;
  tick(0);
  EXPECT_DEATH(tick(0.5), "came before any usable sample");
}
TEST_F(TransportWatchTest, AfterTheDeviceWasLost) {
  tick(1);
  port_->input.lost = true;
  tick(1);
  port_->input.lost = false;
  EXPECT_DEATH(for (int i = 0; i < 100; ++i) tick(1), "was sent after the device was lost");
}
TEST_F(TransportWatchTest, ARearmForgivesIt) {
  port_->input.lost = true;
  tick(0);
  port_->input.lost = false;
  for (int i = 0; i < 100; ++i) tick(0);
  device_->rearm();
  tick(1);
}
// The sample of the tick before the re-arm still says lost.
TEST_F(TransportWatchTest, ARearmForgivesTheLossOfTheTickBefore) {
  port_->input.lost = true;
  tick(0);
  device_->rearm();
  port_->input.lost = false;
  for (int i = 0; i < 100; ++i) tick(1);
}

// The torque has limits of its own, and keeps the same promises.
class TorqueWatch : public TransportWatchTest {
 protected:
  static constexpr DeviceRating kTorqueRating{.torque = 0.2, .torque_rate = 20};
  const DeviceRating& rating() const override { return kTorqueRating; }
  OutputLimits limits() const override { return limitsOf(kTorqueRating); }
  void turn(double torque) {
    device_->read(tick_);
    device_->write({Vec3::Zero(), Vec3(0, torque, 0)}, tick_);
    ++tick_.index;
    tick_.time += tick_.period;
  }
};
TEST_F(TorqueWatch, KeepsItsOwnLimits) {
  for (int i = 0; i <= 10; ++i) turn(0.02 * i);
  EXPECT_DEATH(turn(0.2001), "the torque is above the limit");
  EXPECT_DEATH(turn(0.17), "the torque changed faster than the slew limit");
  EXPECT_DEATH(turn(std::numeric_limits<double>::quiet_NaN()), "the torque is not finite");
}
TEST_F(TransportWatchTest, ADriverWithoutTorqueGetsNone) {
  device_->read(tick_);
  EXPECT_DEATH(device_->write({Vec3::Zero(), Vec3(0, 1e-9, 0)}, tick_), "the torque is above the limit");
}

// The limits are wrong, as if a scene had widened them: the watch enforces the rating.
class LyingLimits : public TransportWatchTest {
 protected:
  OutputLimits limits() const override { return {.force = 1e9, .force_rate = 1e9}; }
};
TEST_F(LyingLimits, AreNotBelieved) {
  for (const double force : {1.0, 2.0, 3.0}) tick(force);
  EXPECT_DEATH(tick(4.0001), "changed faster than the slew limit");
  for (const double force : {4.0, 5.0}) tick(force);
  EXPECT_DEATH(tick(5.0001), "the force is above the limit");
}

}  // namespace
}  // namespace presa
