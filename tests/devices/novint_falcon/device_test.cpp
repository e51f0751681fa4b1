// The device as the graph sees it, with its real thread and a hand-written Falcon. Threads wait for events, not for
// times.
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <numbers>
#include <thread>

#include "devices/novint_falcon/codes.h"
#include "devices/novint_falcon/falcon_device.h"
#include "devices/novint_falcon/finger.h"
#include "tests/devices/novint_falcon/hand_written_falcon.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa::falcon {
namespace {

/// Forwards calls to a Falcon that outlives the device, under a lock, so that the test can inspect the Falcon
/// meanwhile.
class Lent final : public FalconTransport {
 public:
  Lent(HandWrittenFalcon& falcon, std::mutex& mutex) : falcon_(falcon), mutex_(mutex) {}
  bool control(Control control, double now) noexcept override {
    const std::scoped_lock lock(mutex_);
    return falcon_.control(control, now);
  }
  bool write(std::span<const std::uint8_t> bytes, double now) noexcept override {
    const std::scoped_lock lock(mutex_);
    return falcon_.write(bytes, now);
  }
  std::size_t read(std::span<std::uint8_t> buffer, double now) noexcept override {
    const std::scoped_lock lock(mutex_);
    return falcon_.read(buffer, now);
  }
  bool lost() const noexcept override {
    const std::scoped_lock lock(mutex_);
    return falcon_.lost();
  }

 private:
  HandWrittenFalcon& falcon_;
  std::mutex& mutex_;
};

/// A Falcon with the lock for inspecting it.
struct FalconBench {
  template <class Function>
  auto with(Function function) {
    const std::scoped_lock lock(mutex);
    return function(falcon);
  }
  FalconDevice::Connect connect() {
    return [this] { return std::make_unique<Lent>(falcon, mutex); };
  }
  std::unique_ptr<FalconTransport> transport() { return std::make_unique<Lent>(falcon, mutex); }

  HandWrittenFalcon falcon;
  std::mutex mutex;
};

FalconSettings settingsOf(const Pose& X_WD = {}, double scale = 1) {
  FalconSettings settings;
  settings.role = "thumb";
  settings.where = {"desk.xml", 3, 1};
  settings.X_WD = X_WD;
  settings.scale = scale;
  settings.realtime = true;
  return settings;
}

const Tick kTick{.index = 1, .time = 0, .period = 1e-3};

template <class Condition>
void waitUntil(Condition condition) {
  while (!condition()) std::this_thread::yield();
}

/// Code and text of the only error.
std::pair<int, std::string> refusal(FalconDevice& device) {
  try {
    device.open();
  } catch (const InputError& error) {
    return {error.diagnostics().all().at(0).code, error.what()};
  }
  return {0, "it was opened"};
}

TEST(FalconIo, CarriesSamplesOneWayAndForcesTheOther) {
  FalconBench bench;
  bench.falcon.encoders = {300, -200, 100};
  {
    FalconIo io(bench.transport(), {}, {});
    waitUntil([&] { return io.latest(kTick).valid; });
    EXPECT_NEAR((io.latest(kTick).p_DH * 1e3 - Vec3(14.528, -11.579, 136.148)).norm(), 0, 1e-3);
    waitUntil([&] {
      io.push({1, 2, 3});
      return bench.with([](auto& falcon) { return !falcon.sent.back().zero(); });
    });
  }
  // the driver closed cleanly: the last packets have zero force
  ASSERT_GT(bench.falcon.sent.size(), 13U);
  for (std::size_t i = bench.falcon.sent.size() - 3; i < bench.falcon.sent.size(); ++i)
    EXPECT_TRUE(bench.falcon.sent[i].zero());
}

TEST(FalconIo, TheHapticThreadNeitherWaitsNorAllocates) {
  FalconBench bench;
  FalconIo io(bench.transport(), {}, {});
  waitUntil([&] { return io.latest(kTick).valid; });
  RealTimeGuard guard;
  for (int i = 0; i < 1000; ++i) {
    static_cast<void>(io.latest(kTick));
    io.push({1, 0, 0});
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

// When the I/O thread is stuck, its last sample becomes invalid after two ticks. Catch-up ticks after a stall happen at
// one instant and do not count.
TEST(FalconIo, ASilentThreadIsNoticedByTheHapticThread) {
  FalconBench bench;
  FalconIo io(bench.transport(), {}, {});
  waitUntil([&] { return io.latest(kTick).valid; });
  Tick catch_up = kTick;
  catch_up.catch_up = true;
  std::unique_lock stuck(bench.mutex, std::defer_lock);
  bool survived = false;
  for (int attempt = 0; attempt < 100 && !survived; ++attempt) {  // its last sample may be invalid
    waitUntil([&] { return io.latest(kTick).valid; });
    stuck.lock();
    for (int i = 0; i < 50; ++i) survived = io.latest(catch_up).valid;
    if (!survived) stuck.unlock();
  }
  ASSERT_TRUE(survived) << "made-up ticks take no time";
  int held = 0;
  while (io.latest(kTick).valid) ++held;
  EXPECT_LE(held, 2 + 1);  // one more if a sample is published in the meantime
  EXPECT_FALSE(io.latest(kTick).valid);
  stuck.unlock();
  waitUntil([&] { return io.latest(kTick).valid; });
}

TEST(FalconIo, UnpluggedIsSaid) {
  FalconBench bench;
  FalconIo io(bench.transport(), {}, {});
  waitUntil([&] { return io.latest(kTick).valid; });
  bench.with([](auto& falcon) { falcon.unplugged = true; });
  waitUntil([&] { return io.status().state == LinkState::kDead; });
  EXPECT_EQ(io.status().fault, LinkFault::kLost);
  EXPECT_FALSE(io.latest(kTick).valid);
}

TEST(FalconIo, AFaultIsLeftByArmingAgain) {
  FalconBench bench;
  FalconIo io(bench.transport(), {}, {});
  waitUntil([&] { return io.latest(kTick).valid; });
  bench.with([](auto& falcon) { falcon.homed = 3; });
  waitUntil([&] { return io.status().state == LinkState::kLatched; });
  bench.with([](auto& falcon) { falcon.homed = 7; });
  io.rearm();
  waitUntil([&] { return io.latest(kTick).valid; });
}

// Otherwise the output stage would latch the fault again in the tick of its re-arm.
TEST(FalconIo, TheFaultFromBeforeARearmIsNotReportedAfterIt) {
  FalconBench bench;
  FalconIo io(bench.transport(), {}, {});
  waitUntil([&] { return io.latest(kTick).valid; });
  bench.with([](auto& falcon) { falcon.homed = 3; });
  waitUntil([&] { return io.latest(kTick).lost; });
  const std::unique_lock stuck(bench.mutex);  // the I/O thread waits
  io.rearm();
  EXPECT_FALSE(io.latest(kTick).lost);
}

TEST(FalconIo, EndsWhileADeviceIsStillSilent) {
  FalconBench bench;
  bench.falcon.loaded = false;
  FalconIo io(bench.transport(), {0xaa, 0x08}, {});
  waitUntil([&] { return io.status().state == LinkState::kStarting; });
}

// p = X_WD (scale p_D): a quarter turn about x maps the device's z, towards the user, to -y, and its y to z.
TEST(FalconDevice, StandsInTheWorldWhereTheRigPutsIt) {
  FalconBench bench;
  const double half = std::sqrt(0.5);
  FalconDevice device(settingsOf({{0.1, 0.2, 0.3}, Quat(half, half, 0, 0)}, 2), bench.connect());
  device.open();
  FingerInput finger;
  waitUntil([&] { return (finger = device.read(kTick)).valid; });
  EXPECT_NEAR((finger.p_WH - Vec3(0.1, 0.2 - 2 * 0.134602, 0.3)).norm(), 0, 1e-6);

  // 2 N along -y of the world push along the device's z at any scale: -249.4 counts per newton
  waitUntil([&] {
    device.write(Vec3(0, -2, 0), kTick);
    return bench.with([](auto& falcon) { return falcon.sent.back().force[0] == -499; });
  });
  bench.with([](auto& falcon) { EXPECT_EQ(falcon.sent.back().force, (Counts{-499, -499, -499})); });
  device.close();
  EXPECT_FALSE(device.read(kTick).valid);
}

TEST(FalconDevice, TheMiddleButtonIsTheParticipants) {
  const auto finger_with = [](int buttons) {
    LinkSample sample;
    sample.buttons = static_cast<std::uint8_t>(buttons);
    return fingerOf(sample, {}, 1).buttons;
  };
  EXPECT_EQ(finger_with(kButtonCentre), 1U);
  EXPECT_EQ(finger_with(kButtonForward), 2U);
  EXPECT_EQ(finger_with(kButtonPlus), 4U);
  EXPECT_EQ(finger_with(kButtonMinus), 8U);
  EXPECT_EQ(finger_with(0), 0U);
}

TEST(FalconDevice, VelocityTurnsAndScalesWithThePosition) {
  LinkSample sample;
  sample.v_DH = {0, 0, 1};
  const double half = std::sqrt(0.5);
  EXPECT_NEAR((fingerOf(sample, {{5, 5, 5}, Quat(half, half, 0, 0)}, 3).v_WH - Vec3(0, -3, 0)).norm(), 0, 1e-12);
}

// In virtual time an hour may pass in a second, which no device can follow.
TEST(FalconDevice, RefusesVirtualTime) {
  FalconBench bench;
  FalconSettings settings = settingsOf();
  settings.realtime = false;
  FalconDevice device(settings, bench.connect());
  const auto [code, text] = refusal(device);
  EXPECT_EQ(code, kNeedsRealTime);
  EXPECT_NE(text.find("desk.xml:3:1: error[E486]"), std::string::npos) << text;
  EXPECT_TRUE(bench.falcon.controls.empty());
}

/// The device must be refused with this error after `homing_wait`, with zero force sent throughout.
void expectUnhomed(FalconBench& bench, double homing_wait, Code wanted, const std::string& words) {
  FalconSettings settings = settingsOf();
  settings.homing_wait = homing_wait;
  FalconDevice device(settings, bench.connect());
  const auto [code, text] = refusal(device);
  EXPECT_EQ(code, wanted);
  EXPECT_NE(text.find(words), std::string::npos) << text;
  EXPECT_TRUE(std::all_of(bench.falcon.sent.begin(), bench.falcon.sent.end(), [](auto& s) { return s.zero(); }));
}

TEST(FalconDevice, NotHomedIsSaidWithTheEncodersThatAreMissing) {
  FalconBench bench;
  bench.falcon.homed = 2;
  expectUnhomed(bench, 0.02, kNotHomed, "no reference seen by encoder 1, 3");
}

// No force before replies come regularly; the error names the gaps and not the grip.
TEST(FalconDevice, GapsInItsRepliesAreSaidForWhatTheyAre) {
  FalconBench bench;
  bench.falcon.damage = [replies = 0](Bytes reply) mutable { return ++replies % 5 == 0 ? Bytes{} : reply; };
  expectUnhomed(bench, 0.05, kUnevenReplies, "the grip is homed, but its replies leave gaps");
}

TEST(FalconDevice, NoFirmwareIsSaidWithTheSettingToAdd) {
  FalconBench bench;
  bench.falcon.loaded = false;
  FalconDevice device(settingsOf(), bench.connect());
  const auto [code, text] = refusal(device);
  EXPECT_EQ(code, kNoFirmwareNamed);
  EXPECT_NE(text.find("<set key=\"firmware\""), std::string::npos) << text;
}

TEST(FalconDevice, TenWrongEchoesNameThePowerAndTheHub) {
  FalconBench bench;
  bench.falcon.loaded = false;
  bench.falcon.wont_run = true;
  bench.falcon.garble = [](int, std::size_t, Bytes echo) {
    echo[2] = 0x77;
    return echo;
  };
  FalconSettings settings = settingsOf();
  settings.firmware = {0xaa, 0x08, 0x00, 0x00};
  FalconDevice device(settings, bench.connect());
  const auto [code, text] = refusal(device);
  EXPECT_EQ(code, kEchoWrong);
  EXPECT_NE(text.find("byte 2 of 4: sent 00, echoed 77"), std::string::npos) << text;
  EXPECT_NE(text.find("10 attempts"), std::string::npos) << text;
  EXPECT_NE(text.find("power"), std::string::npos);
  EXPECT_NE(text.find("hub"), std::string::npos);
}

}  // namespace
}  // namespace presa::falcon
