#include "experiments/study/conditions.h"

#include <algorithm>

#include "framework/device/wrapped_device.h"

namespace presa {
namespace {

/// A tick without a command, as in a stall, repeats the one before: commands arrive during the stall, too.
class DelayedDevice final : public WrappedDevice {
 public:
  DelayedDevice(std::unique_ptr<Device> device, std::size_t ticks)
      : WrappedDevice(std::move(device)), line_(ticks, {}) {}

  FingerInput read(const Tick& tick) noexcept override {
    for (; written_ < tick.index; ++written_) inner().write(line_.pass(last_), tick);
    return inner().read(tick);
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    last_ = F_H_W;
    inner().write(line_.pass(F_H_W), tick);
    written_ = tick.index + 1;
  }

 private:
  DelayLine<Wrench> line_;
  Wrench last_;
  std::uint64_t written_ = 0;  // ticks whose command is on the line
};

}  // namespace

LateTicks::LateTicks(const Conditions& conditions, std::uint64_t seed) : random_(seed, "late ticks") {
  const auto of = [&](RateGroup group) -> Group& { return groups_[static_cast<std::size_t>(group)]; };
  of(RateGroup::kHaptic).jitter = conditions.haptic;
  of(RateGroup::kCollision).jitter = conditions.collision;
  of(RateGroup::kDynamics).jitter = conditions.dynamics;
}

bool LateTicks::any() const {
  return std::ranges::any_of(groups_, [](const Group& group) { return group.jitter.share > 0; });
}

bool LateTicks::operator()(RateGroup group) {
  Group& late = groups_[static_cast<std::size_t>(group)];
  if (!(late.jitter.share > 0)) return false;
  if (++late.waited < late.period) return true;
  late.waited = 0;
  late.period = random_.uniform() < late.jitter.share ? late.jitter.periods : 1;
  return false;
}

std::unique_ptr<Device> behindLine(std::unique_ptr<Device> device, std::size_t ticks) {
  return ticks == 0 ? std::move(device) : std::make_unique<DelayedDevice>(std::move(device), ticks);
}

}  // namespace presa
