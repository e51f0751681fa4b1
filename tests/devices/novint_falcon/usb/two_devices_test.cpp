// Row 1 through libusb: two drivers behind their output stages; one Falcon is unplugged, and the forces at the other's
// model are judged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/core/graph/graph_builder.h"
#include "framework/core/schedule/clock.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_modules.h"
#include "tests/devices/novint_falcon/usb/drivers.h"

namespace presa::falcon_model::test {
namespace {

/// Replaces the rendering: a constant force for both fingers.
class ConstantForce final : public Module {
 public:
  ConstantForce() : Module("rendering", RateGroup::kHaptic) { out.value = ContactExchange(2); }
  void step(const Tick& tick) noexcept override {
    for (std::size_t f : {0UL, 1UL}) late += device->fingers[f].valid ? 0 : 1;
    out.value.time = tick.time;
    for (std::size_t f : {0UL, 1UL}) out.value.fingers[f].f_H_W = {0, 0, 3};
  }
  In<DeviceState> device{*this, "device_state"};
  Out<ContactExchange> out{*this, "contact_exchange"};
  int late = 0;  ///< late or missing samples
};

// The force on the other device must be zero within 20 requests of its driver. The time this takes on the shared
// machine is printed, not judged.
TEST(TwoFalconsOverUsb, OneIsPulledOutAndTheOtherGoesToZero) {
  EmulatedBus bus;
  EmulatedFalcon &thumb = bus.add(ready()), &index = bus.add(ready());
  index.with([](FalconModel& model, double) { model.limits({.force = 4, .force_rate = 1000, .jitter = 1e-3}); });
  DeviceList devices;
  for (const std::string port : {"1-1", "1-2"}) {
    auto driver = std::make_unique<falcon::FalconDevice>(settingsOf(port), [port] {
      return falcon::connectOverUsb(port, {"desk.xml", 3, 1});
    });
    OPENED_OR_LATE(*driver);
    devices.push_back(std::move(driver));
  }
  RunControl control;
  GraphBuilder builder;
  builder.add(std::make_unique<DeviceInput>(devices, control));
  const ConstantForce& rendering = builder.add(std::make_unique<ConstantForce>());
  const FingerSafety safety{.limits = {.force = 4, .soft_start = 0.1}};
  builder.add(std::make_unique<DeviceOutput>(devices, std::vector{safety, safety}, Rates{}, false));
  builder.connectByName();
  Graph graph = builder.build();

  const RateTable rates{Rates{}};
  std::uint64_t tick = 0;
  std::int64_t wake = monotonicNs();
  const auto runUntil = [&](const std::function<bool()>& condition) {
    for (const std::uint64_t end = tick + 20'000; tick < end;) {
      if (condition()) return true;
      sleepUntilNs(wake += 1'000'000);
      wake = std::max(wake, monotonicNs() - 1'000'000);
      graph.step(RateGroup::kHaptic, rates.tick(RateGroup::kHaptic, tick++));
    }
    return false;
  };
  const auto felt = [](EmulatedFalcon& falcon) {
    return falcon.with([](FalconModel& model, double) { return model.received().meant_D.norm(); });
  };
  REACHED_OR_LATE(runUntil([&] { return felt(thumb) > 0.5; }), rendering.late);
  REACHED_OR_LATE(runUntil([&] { return felt(index) > 0.5; }), rendering.late);

  int requests = 0, zero_after = 0;
  double zero_at = 0;
  const double pulled = index.now();
  index.with([&](FalconModel& model, double) {
    model.onRequest([&](const Received& request) {
      ++requests;
      if (zero_at > 0 || request.counts != std::array{0, 0, 0}) return;
      zero_after = requests;
      zero_at = request.time;
    });
  });
  thumb.unplug();
  EXPECT_TRUE(runUntil([&] { return index.with([&](FalconModel&, double) { return zero_at > 0; }); }));
  EXPECT_LE(zero_after, 20);
  std::printf("zero after %d requests, %.1f ms of the machine's clock\n", zero_after, 1e3 * (zero_at - pulled));
  // latched: no force returns, whether or not the other device is plugged in again
  thumb.plug();
  const std::uint64_t later = tick + 700;
  runUntil([&] { return tick >= later; });
  index.with([](FalconModel& model, double) {
    EXPECT_FALSE(model.holdsForce());
    EXPECT_THAT(model.violations(), testing::IsEmpty());
    model.onRequest(nullptr);
  });
  for (const auto& device : devices) device->close();
}

}  // namespace
}  // namespace presa::falcon_model::test
