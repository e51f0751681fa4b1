#include "devices/linking_hand/linked_pair.h"

#include <cmath>
#include <numbers>

#include "framework/core/math/random.h"

namespace presa::linking {
namespace {

constexpr double kSlow = 0.1, kFast = 0.4;  // [Hz]: a person who leads an arm
constexpr double kBegin = 2;                // [s] until the path has its full size

}  // namespace

LinkedPair::LinkedPair(const PairSettings& settings)
    : settings_(settings), middle_(0.5 * (settings.p_WD[0] + settings.p_WD[1])) {
  RandomStream stream(settings.seed, "path of the link");
  for (int i = 0; i < 3; ++i) {
    amplitude_[i] = settings.size * stream.uniform(0.5, 1);
    rate_[i] = stream.uniform(kSlow, kFast);
    phase_[i] = stream.uniform(0, 2 * std::numbers::pi);
  }
  for (std::size_t i : {0U, 1U}) tips_[i].p_WH = start(i);
}

Vec3 LinkedPair::centreAt(double time) const noexcept {
  const double grown = time < kBegin ? 0.5 - 0.5 * std::cos(std::numbers::pi * time / kBegin) : 1;
  const Vec3 angle = 2 * std::numbers::pi * time * rate_ + phase_;
  return middle_ + grown * amplitude_.cwiseProduct(Vec3(angle.array().sin()));
}

Vec3 LinkedPair::tipAt(std::size_t device, double time) const noexcept {
  const Vec3 reach = centreAt(time) - settings_.p_WD[device];
  return settings_.p_WD[device] + reach - settings_.link * reach.normalized();
}

Vec3 LinkedPair::centreOf(std::size_t device) const noexcept {
  const Vec3 tip = tips_[device].p_WH;
  return tip + settings_.link * (tip - settings_.p_WD[device]).normalized();
}

HandPush LinkedPair::push(std::size_t device, const Tick& tick) noexcept {
  if (held_for_ != tick.index) {  // once a tick, from the fingertips of one moment
    held_for_ = tick.index;
    joint_ = kStiffness * (centreOf(1) - centreOf(0)) + kDamping * (tips_[1].v_WH - tips_[0].v_WH);
  }
  HandPush push;
  push.force_W = device == 0 ? joint_ : Vec3(-joint_);
  if (device != settings_.leader) return push;
  // the target in the middle of the coming period, and its rate
  const double from = tick.time, to = tick.time + tick.period;
  push.p_WT = 0.5 * (tipAt(device, from) + tipAt(device, to));
  push.v_WT = (tipAt(device, to) - tipAt(device, from)) / tick.period;
  return push;
}

}  // namespace presa::linking
