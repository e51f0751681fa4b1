#include "devices/percro_arm/homing.h"

#include <algorithm>
#include <cmath>

#include "devices/percro_arm/dynamics.h"

namespace presa::percro {
namespace {

constexpr double kBand = 2 * std::numbers::pi * 4;  // bandwidth of the position loop [rad/s]
const Vec3 kSeekRate{0.15, 0.15, 0.06};             // [rad/s], [m/s]: at most 10 cm/s at the tip
const Vec3 kEdgeRate{0.02, 0.02, 0.01};
const Vec3 kMargin{0.008, 0.008, 0.004};  // travel beyond an edge before reversing
const Vec3 kLag{0.06, 0.06, 0.03};        // lag behind the setpoint that means blocked
const Vec3 kSpread{4e-4, 4e-4, 2e-4};     // max spread of edges of one direction: three counts

}  // namespace

Homing::Homing(const Parameters& parameters, const Markers& markers, double period)
    : parameters_(parameters), markers_(markers), period_(period) {
  const Vec3 inertia = ArmDynamics(parameters, Vec3::Zero()).inertia({0, 0, 0.3});
  stiffness_ = kBand * kBand * inertia;
  damping_ = 2 * kBand * inertia;
  integral_gain_ = 0.3 * kBand * stiffness_;
}

/// Records an edge; after enough edges computes the offset and goes on to the next joint.
void Homing::meetEdge(int joint, double told, bool covered) noexcept {
  const std::size_t way = covered ? 1 : 0;
  last_edge_ = told;
  if (++edges_ == 1) return;  // ignore the first edge: it is met at seek rate
  const bool first = edges_ <= 3;
  sum_[way] += told / kPasses;
  low_[way] = first ? told : std::min(low_[way], told);
  high_[way] = first ? told : std::max(high_[way], told);
  if (std::max(high_[0] - low_[0], high_[1] - low_[1]) > kSpread[joint] && !first) failure_ = Failure::kUnsteady;
  if (edges_ <= 2 * kPasses) return;
  offset_[joint] = 0.5 * (sum_[0] + sum_[1]) - (markers_.at[joint] - 0.5 * markers_.hysteresis);
  if (failure_ != Failure::kNone) return;
  ++turn_, edges_ = 0, direction_ = 0, travelled_ = 0, sum_ = {};
}

/// Rate of the setpoint: towards the marker, then back and forth over its edge.
double Homing::setpointRate(int joint, double told, bool covered) noexcept {
  if (direction_ == 0) direction_ = covered ? -1 : 1, was_covered_ = covered;
  if (covered != was_covered_) {
    was_covered_ = covered;
    const int before = turn_;
    meetEdge(joint, told, covered);
    if (turn_ != before) return 0;
  }
  if (edges_ > 0 && direction_ * (told - last_edge_) > kMargin[joint]) direction_ = -direction_;
  return direction_ * (edges_ == 0 ? kSeekRate[joint] : kEdgeRate[joint]);
}

Vec3 Homing::step(const Joints& told, const Vec3& rates, const std::array<bool, 3>& covered) noexcept {
  if (!started_) setpoint_ = told, started_ = true;
  Vec3 wanted = Vec3::Zero();
  if (turn_ < 3 && failure_ == Failure::kNone) {
    const int joint = kOrder[static_cast<std::size_t>(turn_)];
    const Geometry& g = parameters_.geometry;
    const Vec3 range{2 * g.tilt_range, 2 * g.yaw_range, g.length_max - g.length_min};
    wanted[joint] = setpointRate(joint, told[joint], covered[static_cast<std::size_t>(joint)]);
    if (edges_ == 0) travelled_ += std::abs(wanted[joint]) * period_;
    if (std::abs(setpoint_[joint] - told[joint]) > kLag[joint]) failure_ = Failure::kBlocked;
    if (travelled_ > range[joint]) failure_ = Failure::kNoMarker;
  }
  if (failure_ != Failure::kNone) return Vec3::Zero();  // no torque
  setpoint_ += period_ * wanted;
  const Vec3 lag = setpoint_ - told;
  integral_ += period_ * integral_gain_.cwiseProduct(lag);
  return stiffness_.cwiseProduct(lag) + damping_.cwiseProduct(wanted - rates) + integral_;
}

}  // namespace presa::percro
