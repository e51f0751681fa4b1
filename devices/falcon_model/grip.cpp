#include "devices/falcon_model/grip.h"

#include <cmath>
#include <optional>

#include "devices/falcon_model/legs.h"

namespace presa::falcon_model {
namespace {

const Vec3 kRest(0, 0, 0.125);        // initial position [m]
constexpr double kInnermost = 0.075;  // min z [m]
constexpr double kStretched = 60;     // legs count as stretched where the Jacobian exceeds this [rad/m]

Vec3 torquesOf(const std::array<int, 3>& counts) { return kTorquePerCount * Vec3(counts[0], counts[1], counts[2]); }

}  // namespace

Grip::Grip(const GripSettings& settings)
    : settings_(settings),
      plant_({settings.mass, settings.hand_stiffness, settings.hand_damping + settings.damping}, kStep),
      hand_([](double) { return kRest; }),
      target_(kRest) {
  plant_.reset(kRest);
  place(kRest);
}

void Grip::switchOn() {
  drive_ = {};
  homed_ = passed_out_ = {};
  seeking_ = false;
  offset_ = {};
  const std::array<int, 3> counts = counters();
  for (const std::size_t i : {0UL, 1UL, 2UL}) offset_[i] = -counts[i];
}

void Grip::seekReferences(bool seek) {
  seeking_ = seek;
  if (!seek) passed_out_ = {};  // encoders without a reference start again
}

void Grip::reference() {
  homed_ = {true, true, true};
  offset_ = {};
}

void Grip::advance(double time) {
  const auto wanted = static_cast<std::int64_t>(std::floor(time / kStep + 1e-6));
  while (steps_ < wanted) step();
}

void Grip::step() {
  ++steps_;
  const Vec3 before = target_, start = plant_.position();
  target_ = hand_(static_cast<double>(steps_) * kStep);
  // the hand's damper moves with its target, the device's damper is fixed
  const double share = settings_.hand_damping / (settings_.hand_damping + settings_.damping);
  const Vec3 pushed = force();
  plant_.step(target_, share * (target_ - before) / kStep, pushed);
  if (!place(plant_.position())) plant_.reset(start);
  energy_ += pushed.dot(plant_.position() - start);
  findReferences();
}

/// Places the grip; false beyond the end stops.
bool Grip::place(const Vec3& p_D) {
  const std::optional<Vec3> thighs = thighsAt(p_D);
  if (!thighs || p_D.z() < kInnermost) return false;
  const Mat3 rates = thighRates(p_D, *thighs);
  if (rates.norm() > kStretched) return false;
  thighs_ = *thighs;
  rates_ = rates;
  return true;
}

void Grip::findReferences() {
  for (const std::size_t i : {0UL, 1UL, 2UL}) {
    const double count = counted(i);
    if (seeking_ && count > kReference[i]) passed_out_[i] = true;
    if (!seeking_ || homed_[i] || !passed_out_[i] || count > kReference[i]) continue;
    homed_[i] = true;
    offset_[i] = 0;
  }
}

double Grip::counted(std::size_t encoder) const {
  return (thighs_[static_cast<int>(encoder)] - kThighAtZero) / kThighPerCount;
}

std::array<int, 3> Grip::counters() const {
  std::array<int, 3> counts{};
  for (const std::size_t i : {0UL, 1UL, 2UL}) counts[i] = static_cast<int>(std::lround(counted(i))) + offset_[i];
  return counts;
}

unsigned Grip::homed() const { return (homed_[0] ? 1U : 0U) | (homed_[1] ? 2U : 0U) | (homed_[2] ? 4U : 0U); }

Vec3 Grip::force() const { return rates_.transpose() * torquesOf(drive_); }

}  // namespace presa::falcon_model
