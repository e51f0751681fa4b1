#include "experiments/faults/hold.h"

#include <algorithm>
#include <cmath>

#include "experiments/study/experiment_file.h"

namespace presa::faults {
namespace {

constexpr double kWidth = 0.08, kRadius = 0.008;  // of the cube; of a fingertip [m]
constexpr double kStiffness = 1000;               // of the cube's material [N/m]
constexpr double kGrip = 3;                       // [N]: max 4 N with the load, zero within 4 ms
constexpr double kOpen = 0.004;                   // gap before the grasp [m]
constexpr double kLift = 0.05, kLiftBegin = 1.0, kLiftEnd = 1.8;

/// Smooth step from 0 to 1 (cubic) and its rate.
std::pair<double, double> ease(double time, double begin, double end) {
  const double s = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
  return {s * s * (3 - 2 * s), 6 * s * (1 - s) / (end - begin)};
}

}  // namespace

PrescribedFinger::State handAt(const Hold& hold, const HandImpedance& hand, double side, double time) {
  const double depth = kGrip / hand.stiffness + kGrip / kStiffness;
  const auto [closing, closing_rate] = ease(time, 0.3, hold.closed);
  const auto [lift, lift_rate] = ease(time, kLiftBegin, kLiftEnd);
  const double far = kWidth / 2 + kRadius + (hold.deep > 0 ? -hold.deep : kOpen);
  const double near = kWidth / 2 + kRadius - depth;
  PrescribedFinger::State state;
  state.p_WH = {side * (far + closing * (near - far)), 0, 0.05 + kLift * lift};
  state.v_WH = {side * closing_rate * (near - far), 0, kLift * lift_rate};
  return state;
}

void runHold(const Hold& hold, const AtTick& at_tick, const AfterRun& after) {
  const HandImpedance hand;
  double clock = 0;
  std::array<Transport, 2> transports;
  DeviceList fingers;
  for (const std::size_t f : {0UL, 1UL}) {
    const double side = f == 0 ? -1 : 1;
    auto finger = std::make_unique<CompliantFinger>(
        hand, [&hold, hand, side](double time) { return handAt(hold, hand, side, time); }, clock, transports[f]);
    fingers.push_back(
        std::make_unique<FailingDevice>(std::move(finger), f == 0 ? hold.thumb : FailingDevice::Failure{}));
  }
  runHold(hold, {std::move(fingers), transports, clock}, at_tick, after);
}

void runHold(const Hold& hold, HoldDevices devices, const AtTick& at_tick, const AfterRun& after) {
  StudySpec spec;
  spec.scene = hold.scene.starts_with('/') ? hold.scene : experimentFile(hold.scene);
  spec.sets = hold.sets;
  spec.force_share = hold.force_share;
  spec.duration = hold.end;
  StudyRun run(spec, std::move(devices.fingers), hold.more);
  Traffic traffic;
  std::array<Vec3, 2> last{};
  bool first = true;
  run.delay([&](RateGroup group, double time) {
    devices.clock = time;
    return hold.held_up && hold.held_up(group, time);
  });
  bool armed = false;
  run.observe([&](const HapticSample& sample) {
    if (!armed && devices.clock >= hold.rearm) run.rearm();
    armed = devices.clock >= hold.rearm;
    traffic.slew_energy = 0;
    for (const std::size_t f : {0UL, 1UL}) {
      const Vec3& x = sample.device.fingers[f].p_WH;
      if (!first) traffic.slew_energy += kStiffness / 2 * (x - last[f]).squaredNorm();
      last[f] = x;
      traffic.force[f] = devices.transports[f].force;
      traffic.energy[f] = devices.transports[f].energy;
    }
    first = false;
    traffic.step = std::max(devices.transports[0].largest_step, devices.transports[1].largest_step);
    at_tick(devices.clock, traffic);
  });
  run.run();
  if (after) after(run);
}

void requireBounded(const Traffic& traffic, double limit, Outcome& outcome) {
  if (!outcome.broken.empty()) return;
  for (const Vec3& force : traffic.force) {
    if (!force.allFinite()) outcome.broken.emplace_back("a force that is not finite");
    if (force.norm() > limit * (1 + 1e-9)) outcome.broken.emplace_back("a force above the limit");
  }
}

double Judge::force(const Traffic& traffic) const {
  double max = 0;
  for (const std::size_t f : {0UL, 1UL}) {
    if ((fingers_ >> f & 1U) != 0) max = std::max(max, traffic.force[f].norm());
  }
  return max;
}

void Judge::see(double time, const Traffic& traffic) {
  const double now = force(traffic), energy = traffic.energy[0] + traffic.energy[1];
  outcome_.step = traffic.step;
  if (time < begin_ - 1e-9) {
    before_ = now;
    energy_before_ = energy;
    return;
  }
  if (time > until_ + 1e-9) return;
  if (answered_ < 0 && now < 0.95 * before_) answered_ = time - begin_;
  if (now > 0) last_force_ = time - begin_;
  outcome_.energy = std::max(outcome_.energy, energy - energy_before_);
  outcome_.energy_allowed += traffic.slew_energy;
}

Outcome Judge::outcome() const {
  Outcome result = outcome_;
  result.detection = answered_;
  result.zero = last_force_ + 1e-3;  // the write after the last nonzero one
  if (before_ < 0.5) result.broken.emplace_back("nothing was held when the fault came");
  return result;
}

}  // namespace presa::faults
