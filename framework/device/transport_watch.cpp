#include "framework/device/transport_watch.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "framework/device/wrapped_device.h"

namespace presa {
namespace {

constexpr double kRounding = 1e-9;

class TransportWatch final : public WrappedDevice {
 public:
  TransportWatch(std::unique_ptr<Device> device, const OutputLimits& limits, const RunControl& control)
      : WrappedDevice(std::move(device)), limits_(limits), control_(control) {}

  FingerInput read(const Tick& tick) noexcept override {
    const FingerInput input = inner().read(tick);
    const std::uint32_t rearms = control_.rearms.load(std::memory_order_relaxed);
    if (rearms != rearms_) lost_for_ = 0, usable_ = false;
    rearms_ = rearms;
    if (input.lost || lost_for_ > 0) lost_for_ += tick.period;
    usable_ = usable_ || (input.valid && input.p_WH.allFinite());
    return input;
  }

  void write(const Vec3& f, const Tick& tick) noexcept override {
    const double force = std::hypot(f.x(), f.y(), f.z());
    const double step = std::hypot(f.x() - sent_.x(), f.y() - sent_.y(), f.z() - sent_.z());
    if (!std::isfinite(force)) fail("is not finite", force, 0, tick);
    if (force > limits_.force * (1 + kRounding)) fail("is above the limit", force, limits_.force, tick);
    const double slew = limits_.force_rate * (tick.resumed ? Executor::kGap : tick.period);
    if (step > slew * (1 + kRounding) + 1e-12) fail("changed faster than the slew limit", step, slew, tick);
    if (!usable_ && force > 0) fail("came before any usable sample", force, 0, tick);
    // what is on its way down may take its time, once
    const double down = limits_.force / limits_.force_rate + limits_.fade_out + 0.01;
    if (tick.resumed && force > 0) fail("came right after a gap", force, 0, tick);
    if (lost_for_ > down && force > 0) fail("outlived the device", force, 0, tick);
    sent_ = f;
    inner().write(f, tick);
  }

 private:
  [[noreturn]] static void fail(const char* what, double found, double allowed, const Tick& tick) noexcept {
    std::fprintf(stderr, "transport: the force %s: %.17g N, allowed %.17g N, at %.6f s\n", what, found, allowed,
                 tick.time);
    std::abort();
  }

  OutputLimits limits_;
  const RunControl& control_;
  Vec3 sent_ = Vec3::Zero();
  std::uint32_t rearms_ = 0;
  double lost_for_ = 0;  // [s]
  bool usable_ = false;
};

}  // namespace

std::unique_ptr<Device> watched(std::unique_ptr<Device> device, const OutputLimits& limits, const RunControl& control) {
  static const bool wanted = std::getenv("PRESA_WATCH_TRANSPORT") != nullptr;
  if (!wanted) return device;
  return std::make_unique<TransportWatch>(std::move(device), limits, control);
}

}  // namespace presa
