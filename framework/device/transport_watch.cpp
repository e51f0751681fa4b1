#include "framework/device/transport_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "framework/core/schedule/executor.h"
#include "framework/device/wrapped_device.h"

namespace presa {
namespace {

constexpr double kWriteRounding = 1e-9;
constexpr double kGone = 0.02;  // a force may take this long to zero after the device is lost [s]

class TransportWatch final : public WrappedDevice {
 public:
  TransportWatch(std::unique_ptr<Device> device, const OutputLimits& limits, const DeviceRating& rating)
      : WrappedDevice(std::move(device)),
        force_{"force", "N", std::min(limits.force, rating.force), std::min(limits.force_rate, rating.force_rate)},
        torque_{"torque", "N m", std::min(limits.torque, rating.torque),
                std::min(limits.torque_rate, rating.torque_rate)} {}

  FingerInput read(const Tick& tick) noexcept override {
    const FingerInput input = inner().read(tick);
    if (input.lost || lost_for_ > 0) lost_for_ += tick.period;
    usable_ = usable_ || (input.valid && input.p_WH.allFinite());
    return input;
  }

  // Not RunControl::rearms: that may change after this tick has read it, and the sample would be from before the re-arm.
  void rearm() noexcept override {
    lost_for_ = 0;
    usable_ = false;
    inner().rearm();
  }

  void write(const Wrench& wrench, const Tick& tick) noexcept override {
    judge(force_, wrench.f, sent_.f, tick);
    judge(torque_, wrench.t, sent_.t, tick);
    sent_ = wrench;
    inner().write(wrench, tick);
  }

 private:
  /// The force or the torque of a wrench.
  struct Part {
    const char *name, *unit;
    double max, rate;
  };

  void judge(const Part& part, const Vec3& f, const Vec3& before, const Tick& tick) const noexcept {
    const double force = f.norm(), step = (f - before).norm();
    if (!f.allFinite()) fail(part, "is not finite", force, 0, tick);
    if (force > part.max * (1 + kWriteRounding)) fail(part, "is above the limit", force, part.max, tick);
    const double slew = part.rate * (tick.resumed ? Executor::kGap : tick.period);
    if (step > slew * (1 + kWriteRounding) + 1e-12) fail(part, "changed faster than the slew limit", step, slew, tick);
    if (!usable_ && force > 0) fail(part, "came before any usable sample", force, 0, tick);
    if (tick.resumed && force > 0) fail(part, "came right after a gap", force, 0, tick);
    if (lost_for_ > kGone + tick.period && force > 0) fail(part, "was sent after the device was lost", force, 0, tick);
  }

  [[noreturn]] static void fail(const Part& part, const char* what, double found, double allowed,
                                const Tick& tick) noexcept {
    std::fprintf(stderr, "transport: the %s %s: %.17g %s, allowed %.17g %s, at %.6f s\n", part.name, what, found,
                 part.unit, allowed, part.unit, tick.time);
    std::abort();
  }

  Part force_, torque_;
  Wrench sent_;
  double lost_for_ = 0;  // [s]
  bool usable_ = false;
};

}  // namespace

std::unique_ptr<Device> watched(std::unique_ptr<Device> device, const OutputLimits& limits,
                                const DeviceRating& rating) {
  static const bool wanted = std::getenv("PRESA_WATCH_TRANSPORT") != nullptr;
  if (!wanted) return device;
  return std::make_unique<TransportWatch>(std::move(device), limits, rating);
}

}  // namespace presa
