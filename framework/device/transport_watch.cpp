#include "framework/device/transport_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "framework/device/wrapped_device.h"

namespace presa {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kGone = 0.02;  // a force may take this long to zero after the device is lost [s]

class TransportWatch final : public WrappedDevice {
 public:
  TransportWatch(std::unique_ptr<Device> device, const OutputLimits& limits, const DeviceRating& rating,
                 const RunControl& control)
      : WrappedDevice(std::move(device)),
        force_(std::min(limits.force, rating.force)),
        force_rate_(std::min(limits.force_rate, rating.force_rate)),
        control_(control) {}

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
    if (force > force_ * (1 + kRounding)) fail("is above the limit", force, force_, tick);
    const double slew = force_rate_ * (tick.resumed ? Executor::kGap : tick.period);
    if (step > slew * (1 + kRounding) + 1e-12) fail("changed faster than the slew limit", step, slew, tick);
    if (!usable_ && force > 0) fail("came before any usable sample", force, 0, tick);
    if (tick.resumed && force > 0) fail("came right after a gap", force, 0, tick);
    if (lost_for_ > kGone + tick.period && force > 0) fail("was sent after the device was lost", force, 0, tick);
    sent_ = f;
    inner().write(f, tick);
  }

 private:
  [[noreturn]] static void fail(const char* what, double found, double allowed, const Tick& tick) noexcept {
    std::fprintf(stderr, "transport: the force %s: %.17g N, allowed %.17g N, at %.6f s\n", what, found, allowed,
                 tick.time);
    std::abort();
  }

  double force_, force_rate_;  // [N], [N/s]
  const RunControl& control_;
  Vec3 sent_ = Vec3::Zero();
  std::uint32_t rearms_ = 0;
  double lost_for_ = 0;  // [s]
  bool usable_ = false;
};

}  // namespace

std::unique_ptr<Device> watched(std::unique_ptr<Device> device, const OutputLimits& limits, const DeviceRating& rating,
                                const RunControl& control) {
  static const bool wanted = std::getenv("PRESA_WATCH_TRANSPORT") != nullptr;
  if (!wanted) return device;
  return std::make_unique<TransportWatch>(std::move(device), limits, rating, control);
}

}  // namespace presa
