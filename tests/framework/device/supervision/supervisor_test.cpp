#include "framework/device/supervision/supervisor.h"

#include <gtest/gtest.h>

#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

/// Keeps the calls that it gets.
struct Notes {
  FingerInput sample;
  Vec3 force = Vec3::Zero();
  int rearms = 0;
  bool closed = false;
};

class NotedDevice final : public Device {
 public:
  explicit NotedDevice(Notes& notes) : notes_(notes) {}
  void close() noexcept override { notes_.closed = true; }
  FingerInput read(const Tick&) noexcept override { return notes_.sample; }
  void write(const Wrench& F_H_W, const Tick&) noexcept override { notes_.force = F_H_W.f; }
  void rearm() noexcept override { ++notes_.rearms; }

 private:
  Notes& notes_;
};

constexpr DeviceRating kRating{.force = 8};
constexpr double kCycle = 0.25e-3;  // [s]

class SupervisorCycle : public testing::Test {
 protected:
  SupervisorCycle() {
    notes_.sample.p_WH = {1, 2, 3};
    notes_.sample.valid = true;
  }
  /// One millisecond: one command, four cycles.
  bool tick(const Vec3& force) {
    share_.command.publish({force}, 0);
    bool goes_on = true;
    for (int i = 0; i < 4; ++i) goes_on = supervisor_.cycle(false, kCycle);
    share_.report.update();
    return goes_on;
  }
  const SupervisorReport& report() { return share_.report.value(); }
  static std::uint64_t none() { return 0; }

  SupervisorShare share_;
  Notes notes_;
  Supervisor supervisor_{share_, std::make_unique<NotedDevice>(notes_), kRating, none};
};

TEST_F(SupervisorCycle, PassesSamplesAndForces) {
  tick(Vec3::Zero());
  for (int i = 0; i < 600; ++i) tick({0, 0, 2});
  EXPECT_EQ(report().finger.p_WH, Vec3(1, 2, 3));
  EXPECT_FALSE(report().dropped);
  EXPECT_EQ(report().sent, Vec3(0, 0, 2));
  EXPECT_EQ(notes_.force, Vec3(0, 0, 2));
  EXPECT_EQ(report().cycles, 4u * 601);
}

TEST_F(SupervisorCycle, TakesNoMemoryAndNoLock) {
  tick(Vec3::Zero());
  RealTimeGuard guard;
  for (int i = 0; i < 600; ++i) tick({0, 0, 2});
  for (int i = 0; i < 100; ++i) supervisor_.cycle(true, kCycle);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST_F(SupervisorCycle, EndsOnlyAfterAFarewellOfZero) {
  tick(Vec3::Zero());
  for (int i = 0; i < 600; ++i) tick({0, 0, 2});
  int cycles = 0;
  for (bool goes_on = true; goes_on; ++cycles) goes_on = supervisor_.cycle(true, kCycle);
  // 2 N at 1 N/ms, then 50 ms of zero
  EXPECT_NEAR(cycles * kCycle, 2e-3 + Supervisor::kZeroForceTime, 2 * kCycle);
  EXPECT_EQ(notes_.force, Vec3::Zero());
  supervisor_.close();
  EXPECT_TRUE(notes_.closed);
}

TEST_F(SupervisorCycle, ARearmReachesTheDeviceOnce) {
  tick(Vec3::Zero());
  share_.rearms = 1;
  tick(Vec3::Zero());
  tick(Vec3::Zero());
  EXPECT_EQ(notes_.rearms, 1);
  EXPECT_EQ(report().rearms_done, 1u);
}

}  // namespace
}  // namespace presa
