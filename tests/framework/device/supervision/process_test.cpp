#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>

#include "experiments/faults/press.h"
#include "framework/core/schedule/clock.h"
#include "framework/device/device_plugin.h"
#include "framework/device/supervision/supervised_device.h"
#include "framework/session/session.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using faults::ProbeLog;
using testing::HasSubstr;

constexpr double kPeriod = 1e-3;  // [s]

/// A probe device in a real supervisor process, ticked by this thread about once a millisecond.
class Supervised : public testing::Test {
 protected:
  Supervised() {
    fd_ = memfd_create("presa-test", 0);
    EXPECT_EQ(ftruncate(fd_, sizeof(ProbeLog)), 0);
    log_ = new (mmap(nullptr, sizeof(ProbeLog), PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0)) ProbeLog;
    setting("log", "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(fd_));
    setting("pos", "0.1 0.2 0.3");
    binding_.role = "thumb";
    binding_.driver = "fault_probe";
    binding_.where = {"rig.xml", 3, 5};
  }
  ~Supervised() override {
    device_.reset();
    munmap(log_, sizeof(ProbeLog));
    close(fd_);
  }
  void setting(const std::string& key, const std::string& value) {
    binding_.settings[key] = {value, {"rig.xml", 4, 7}};
  }
  void open() {
    Diagnostics findings;
    DeviceList made = devicePlugin("fault_probe").create({binding_}, std::make_shared<const World>(), {}, findings);
    ASSERT_FALSE(findings.hasErrors());
    device_ = std::make_unique<SupervisedDevice>(std::move(made.at(0)), binding_, "rig.xml");
    device_->open();
  }
  FingerInput tick(const Vec3& force) {
    sleepUntilNs(monotonicNs() + 1'000'000);
    const Tick tick{.index = ticks_, .time = static_cast<double>(ticks_) * kPeriod, .period = kPeriod};
    ++ticks_;
    const FingerInput finger = device_->read(tick);
    // restarts at zero as the output stage does: if the machine pauses this thread, the supervisor drops the force
    device_->write(finger.valid ? force : Vec3::Zero(), tick);
    return finger;
  }
  /// Ticks until the condition holds, at most for five seconds.
  template <class Holds>
  bool ticksUntil(const Vec3& force, const Holds& holds) {
    for (int i = 0; i < 5000; ++i) {
      if (holds(tick(force))) return true;
    }
    return false;
  }
  double lastForce() const { return log_->written > 0 ? log_->entries[log_->written - 1].force : -1; }
  bool press() {
    tick(Vec3::Zero());
    return ticksUntil({0, 0, 3}, [&](const FingerInput&) { return std::abs(lastForce() - 3) < 1e-9; });
  }

  int fd_ = -1;
  ProbeLog* log_ = nullptr;
  DeviceBinding binding_;
  std::unique_ptr<SupervisedDevice> device_;
  std::uint64_t ticks_ = 0;
};

TEST_F(Supervised, LivesInAnotherProcessAndTakesNoMemoryThere) {
  open();
  EXPECT_EQ(log_->writer, device_->supervisor());
  EXPECT_NE(log_->writer, getpid());
  ASSERT_TRUE(press());
  EXPECT_TRUE(ticksUntil({0, 0, 3}, [](const FingerInput& finger) {
    return finger.valid && finger.p_WH == Vec3(0.1, 0.2, 0.3) && !finger.lost;
  }));
  EXPECT_GT(device_->report().cycles, 1000u);
  EXPECT_EQ(device_->report().allocated, 0u);
  EXPECT_THAT(testing::PrintToString(device_->notes()),
              HasSubstr("takes the force to zero when this one stops or dies"));
}

TEST_F(Supervised, ExchangesWithoutASystemCall) {
  if (!syscallTrapWorks()) GTEST_SKIP() << "no filters of system calls here";
  open();
  tick(Vec3::Zero());
  EXPECT_EQ(runUnderSyscallTrap([&] {
              for (std::uint64_t i = 0; i < 1000; ++i) {
                const Tick tick{.index = i, .time = static_cast<double>(i) * kPeriod, .period = kPeriod};
                device_->read(tick);
                device_->write(Vec3(0, 0, 1), tick);
              }
            }),
            "");
}

TEST_F(Supervised, ClosesAtZeroForceAndLeavesNobody) {
  open();
  ASSERT_TRUE(press());
  const pid_t supervisor = device_->supervisor();
  device_->close();
  EXPECT_EQ(lastForce(), 0);
  EXPECT_EQ(kill(supervisor, 0), -1);
  for (std::uint64_t i = 1; i < log_->written; ++i) {  // 1 N/ms since the write before
    const double elapsed = static_cast<double>(log_->entries[i].time_ns - log_->entries[i - 1].time_ns) * 1e-9;
    EXPECT_LE(log_->entries[i].step, 1000 * elapsed * (1 + 1e-6) + 1e-12);
  }
}

TEST_F(Supervised, SignalsForTheProgramDoNotReachIt) {
  open();
  ASSERT_TRUE(press());
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGTSTP, SIGQUIT}) kill(device_->supervisor(), signal);
  const std::uint64_t cycles = device_->report().cycles;
  EXPECT_TRUE(ticksUntil({0, 0, 3}, [&](const FingerInput&) { return device_->report().cycles > cycles + 400; }));
  EXPECT_NE(getpgid(device_->supervisor()), getpgid(getpid()));
}

TEST_F(Supervised, ASupervisorThatDiesIsALostDevice) {
  open();
  ASSERT_TRUE(press());
  kill(device_->supervisor(), SIGKILL);
  EXPECT_TRUE(ticksUntil({0, 0, 3}, [](const FingerInput& finger) { return finger.lost && !finger.valid; }));
  device_->close();  // does not wait for the supervisor
}

// What a re-arm in `presa run` begins with: the device is opened again by a supervisor of its own. One that is not lost
// stays as it is.
TEST_F(Supervised, OneThatWasLostIsTakenOverByANewSupervisor) {
  open();
  ASSERT_TRUE(press());
  const pid_t first = device_->supervisor();
  device_->reopen(false);
  EXPECT_EQ(device_->supervisor(), first);
  kill(first, SIGKILL);
  ASSERT_TRUE(ticksUntil({0, 0, 3}, [](const FingerInput& finger) { return finger.lost; }));
  device_->reopen(false);
  EXPECT_NE(device_->supervisor(), first);
  device_->rearm();
  EXPECT_TRUE(ticksUntil(Vec3::Zero(), [](const FingerInput& finger) { return finger.valid && !finger.lost; }));
  EXPECT_TRUE(press());
  EXPECT_EQ(log_->writer, device_->supervisor());
}

// A device that cannot be opened again is reported and stays lost.
TEST_F(Supervised, WhatStaysAwayStaysLost) {
  open();
  kill(device_->supervisor(), SIGKILL);
  ASSERT_TRUE(ticksUntil(Vec3::Zero(), [](const FingerInput& finger) { return finger.lost; }));
  const int kept = dup(fd_), nothing = ::open("/dev/null", O_RDWR);
  dup2(nothing, fd_);  // the probe no longer finds its log
  EXPECT_THROW(device_->reopen(false), InputError);
  EXPECT_TRUE(tick(Vec3::Zero()).lost);
  EXPECT_EQ(dup2(kept, fd_), fd_);
  close(kept);
  close(nothing);
  device_->reopen(false);
  EXPECT_TRUE(ticksUntil(Vec3::Zero(), [](const FingerInput& finger) { return finger.valid && !finger.lost; }));
}

TEST_F(Supervised, WhatTheDriverRefusesIsSaidHere) {
  setting("log", "/nowhere/at/all");
  try {
    open();
    FAIL() << "it opened";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().text(), "/nowhere/at/all: error[E478]: cannot be opened\n");
  }
}

/// A driver that measures its orientation, never opened.
class OrientedDriver final : public Device {
 public:
  FingerInput read(const Tick&) noexcept override { return {}; }
  void write(const Wrench&, const Tick&) noexcept override {}
  bool measuresOrientation() const override { return true; }
};

// Otherwise a real stylus would get no torque, and its recordings no orientation.
TEST(SupervisedDevice, MeasuresTheOrientationThatItsDriverMeasures) {
  EXPECT_TRUE(SupervisedDevice(std::make_unique<OrientedDriver>(), {}, "").measuresOrientation());
}

}  // namespace
}  // namespace presa
