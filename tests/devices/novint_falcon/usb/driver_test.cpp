// The driver through the real libusb, with the model behind an emulated bus. The forces at the model are judged by its
// force watch. Timing is not judged, only the order of events, because the machine is shared.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/novint_falcon/codes.h"
#include "devices/novint_falcon/falcon_device.h"
#include "devices/novint_falcon/usb_bus.h"
#include "framework/core/schedule/clock.h"
#include "tests/devices/novint_falcon/usb/drivers.h"

namespace presa::falcon_model::test {
namespace {

using falcon::FalconDevice;
using falcon::LinkState;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPatience = 20;  // [s] max wait for an event

/// A Falcon on the bus and its driver, with a haptic loop of 1 kHz that pushes with a constant force.
struct FalconBench {
  explicit FalconBench(const ModelSettings& settings = ready()) : falcon(bus.add(settings)) {
    falcon.with([](FalconModel& model, double) {
      // the bus delays and bunches requests: the slew limit holds on the driver's clock, not on the device's
      model.limits({.force = 8, .force_rate = 1000, .jitter = 1e-3});
    });
  }
  /// A hand that repeatedly pulls the grip out and pushes it in.
  void moveHand() {
    falcon.with([](FalconModel& model, double) {
      model.grip().hand([](double time) -> Vec3 { return {0, 0, 0.145 + 0.025 * std::sin(6 * time)}; });
    });
  }
  /// Runs the loop until the condition on (model, driver's sample) holds; false: timed out.
  bool until(const std::function<bool(FalconModel&, const FingerInput&)>& condition) {
    const std::int64_t begin = monotonicNs();
    late = 0;
    for (std::int64_t wake = begin;; wake += 1'000'000) {
      sleepUntilNs(wake);
      ++tick.index;
      tick.time += tick.period;
      const FingerInput finger = driver.read(tick);
      driver.write(force, tick);
      late += finger.valid ? 0 : 1;
      if (falcon.with([&](FalconModel& model, double) { return condition(model, finger); })) return true;
      if (static_cast<double>(monotonicNs() - begin) * 1e-9 > kPatience) return false;
    }
  }
  bool untilFelt(double newtons) {
    return until(
        [newtons](FalconModel& model, const FingerInput&) { return model.received().meant_D.norm() > newtons; });
  }
  bool untilZero() {
    return until([](FalconModel& model, const FingerInput&) { return model.received().counts == std::array{0, 0, 0}; });
  }
  std::vector<std::string> violations() {
    return falcon.with([](FalconModel& model, double) { return model.violations(); });
  }

  EmulatedBus bus;
  EmulatedFalcon& falcon;
  FalconDevice driver = driverOf("");
  Vec3 force{0, 0, 2};
  Tick tick{.period = 1e-3};
  int late = 0;  ///< late or missing samples during the last wait
};

TEST(FalconOverUsb, EnumeratesAndClaims) {
  EmulatedBus bus;
  bus.add(ready());
  bus.add(ready());
  falcon::UsbFailure failure;
  auto found = falcon::listFalcons(failure);
  std::ranges::sort(found, {}, &falcon::UsbFalcon::port);
  ASSERT_EQ(found.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    const auto& one = found[static_cast<std::size_t>(i)];
    EXPECT_EQ(one.port, "1-" + std::to_string(i + 1));
    EXPECT_EQ(one.serial, "FALCON" + std::to_string(i + 1));
    EXPECT_EQ(one.product, "FALCON HAPTIC");
    EXPECT_EQ(one.problem, falcon::UsbProblem::kNone) << one.detail;
  }
  EXPECT_FALSE(falcon::openFalcon("", failure));
  EXPECT_EQ(failure.problem, falcon::UsbProblem::kSeveral);
  falcon::UsbFailure fine;
  const auto second = falcon::openFalcon("FALCON2", fine);
  ASSERT_TRUE(second) << fine.detail;
  // row 19: a second program is refused, with the reason
  falcon::UsbFailure later;
  EXPECT_FALSE(falcon::openFalcon("1-2", later));
  EXPECT_EQ(later.problem, falcon::UsbProblem::kBusy);
  EXPECT_THAT(falcon::describe(later, "1-2"), HasSubstr("another program holds /dev/bus/usb/001/003"));
}

// Seven attempts have a wrong echo, each at another byte; at the eighth the firmware runs. (A busy machine may spoil
// one or two more; the limit of ten is tested in virtual time.)
TEST(FalconOverUsb, LoadsFirmwareAfterSevenBadAttempts) {
  ModelSettings settings;
  settings.loader.firmware = firmware();
  for (int attempt = 0; attempt < 7; ++attempt)
    settings.loader.faults.push_back({attempt, static_cast<std::size_t>(attempt * 37), UploadFault::Kind::kWrongEcho});
  FalconBench bench(settings);
  bench.moveHand();
  const bool opened = opensInTime(bench.driver);
  // the firmware runs and obeys even if its replies are irregular
  bench.falcon.with([](FalconModel& model, double) { EXPECT_GE(model.processor().uploads(), 8); });
  EXPECT_THAT(bench.violations(), IsEmpty());
  SKIP_UNLESS_OPENED(opened);
  EXPECT_GE(bench.driver.status().load.attempts, 7);
  EXPECT_EQ(bench.driver.status().state, LinkState::kOperating);
  REACHED_OR_LATE(bench.untilFelt(1), bench.late);
  EXPECT_THAT(bench.violations(), IsEmpty());
}

TEST(FalconOverUsb, TenWrongEchoesAreSaid) {
  ModelSettings settings;
  settings.loader.firmware = firmware();
  for (int attempt = 0; attempt < 20; ++attempt)
    settings.loader.faults.push_back({attempt, 5, UploadFault::Kind::kCorruptByte});
  FalconBench bench(settings);
  try {
    bench.driver.open();
    FAIL() << "it was opened";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().all().at(0).code, falcon::kEchoWrong);
    EXPECT_THAT(error.what(), HasSubstr("byte 5 of 700"));
    EXPECT_THAT(error.what(), HasSubstr("10 attempts"));
  }
  bench.falcon.with([](FalconModel& model, double) {
    EXPECT_EQ(model.processor().uploads(), 10);
    EXPECT_EQ(model.requests(), 0);
  });
}

TEST(FalconOverUsb, ARefusedSettingIsSaid) {
  FalconBench bench;
  bench.falcon.with([](FalconModel& model, double) { model.refuseRequests(3); });
  EXPECT_THROW(bench.driver.open(), InputError);
}

TEST(FalconOverUsb, ShortAndMergedRepliesAreLivedThrough) {
  FalconBench bench;
  OPENED_OR_LATE(bench.driver);
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  RandomStream random(1, "replies");
  int mutated = 0;
  bench.falcon.with([&](FalconModel& model, double) {
    model.onReply([&](ReplyFate& reply) {
      if (random.below(10) == 0) shorten(reply, random), ++mutated;
      reply.waits = random.below(10) == 0;
    });
  });
  ASSERT_TRUE(bench.until([&](FalconModel&, const FingerInput&) { return mutated > 50; }));
  bench.falcon.with([](FalconModel& model, double) { model.onReply(nullptr); });
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  EXPECT_EQ(bench.driver.status().state, LinkState::kOperating);
  EXPECT_THAT(bench.violations(), IsEmpty());
}

// No reply for half a second of the device's clock: the force is zero meanwhile, and returns.
TEST(FalconOverUsb, SilenceTakesTheForceAwayAndItComesBack) {
  FalconBench bench;
  OPENED_OR_LATE(bench.driver);
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  bench.falcon.with([](FalconModel& model, double now) { model.mute(now, now + 0.5); });
  EXPECT_TRUE(bench.untilZero());
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  EXPECT_THAT(bench.violations(), IsEmpty());
}

// A stall ends transfers but not the connection: the halt is cleared and communication continues.
TEST(FalconOverUsb, AStallIsCleared) {
  FalconBench bench;
  OPENED_OR_LATE(bench.driver);
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  bench.falcon.stallBulk(true);
  EXPECT_TRUE(bench.until([](FalconModel&, const FingerInput& finger) { return !finger.valid; }));
  bench.falcon.stallBulk(false);
  EXPECT_TRUE(bench.until([](FalconModel&, const FingerInput& finger) { return finger.valid; }));
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  EXPECT_THAT(bench.violations(), IsEmpty());
}

TEST(FalconOverUsb, PulledOutInTheGraspAndBackItStartsFromTheBeginning) {
  FalconBench bench;
  OPENED_OR_LATE(bench.driver);
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  const double pulled = bench.falcon.now();
  bench.falcon.unplug();
  ASSERT_TRUE(bench.until([](FalconModel&, const FingerInput& finger) { return finger.lost; }));
  RecordProperty("noticed_ms", static_cast<int>(1e3 * (bench.falcon.now() - pulled)));
  EXPECT_EQ(bench.driver.status().fault, falcon::LinkFault::kLost);
  bench.falcon.plug();
  const int requests = bench.falcon.with([](FalconModel& model, double) { return model.requests(); });
  bench.driver.rearm();
  for (int i = 0; i < 50; ++i) bench.until([](FalconModel&, const FingerInput&) { return true; });
  EXPECT_EQ(bench.falcon.with([](FalconModel& model, double) { return model.requests(); }), requests);
  bench.driver.close();
  bench.moveHand();
  OPENED_OR_LATE(bench.driver);  // loads firmware and homes again
  const int uploads = bench.falcon.with([](FalconModel& model, double) { return model.processor().uploads(); });
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  EXPECT_EQ(uploads, 1);  // opening tries again after replies that were late
  EXPECT_THAT(bench.violations(), IsEmpty());
}

// Closing takes the force to zero at the device.
TEST(FalconOverUsb, ClosedItLeavesZeroBehind) {
  FalconBench bench;
  OPENED_OR_LATE(bench.driver);
  REACHED_OR_LATE(bench.untilFelt(1.5), bench.late);
  bench.driver.close();
  bench.falcon.with([](FalconModel& model, double) {
    EXPECT_FALSE(model.holdsForce());
    EXPECT_THAT(model.violations(), IsEmpty());
  });
}

}  // namespace
}  // namespace presa::falcon_model::test
