// Between sensor samples the linear system of virtual mass and servo is advanced by its exact transition matrix.
// stiffestWall() bisects on the spectral radius of device, hand and sampled wall over one tick.
#include "devices/admittance/drive.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

namespace presa::admittance {
namespace {

double servoRate(const Parameters& p) { return 2 * std::numbers::pi * p.bandwidth; }  // [1/s]

int samplesIn(double period) { return std::max(1, static_cast<int>(std::ceil(period / Drive::kSample - 1e-9))); }

/// Exact transition over one sample with constant force.
Eigen::Matrix<double, 3, 4> sampleMap(const Parameters& p, double sample) {
  const double w = servoRate(p);
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a(0, 1) = 1;
  a(1, 1) = -w, a(1, 2) = w;
  a(2, 2) = -p.viscosity / p.inertia, a(2, 3) = 1 / p.inertia;
  return Eigen::Matrix4d((a * sample).exp()).topRows<3>();
}

/// Force of the hand on the grip for a target at rest at 0: stiffness, damping and inertia; state (x, v, r).
double handForce(const FingerImpedance& hand, double servo, const Vec3& s) {
  return -hand.stiffness * s[0] - hand.damping * s[1] - hand.mass * servo * (s[2] - s[1]);
}

double spectralRadius(const Parameters& p, const FingerImpedance& hand, double stiffness, double period) {
  const int samples = samplesIn(period);
  const auto map = sampleMap(p, period / samples);
  Mat3 tick;
  for (int column = 0; column < 3; ++column) {
    Vec3 s = Vec3::Unit(column);
    const double wall = -stiffness * s[0];
    for (int i = 0; i < samples; ++i) {
      const Eigen::Vector4d with_force(s[0], s[1], s[2], wall + handForce(hand, servoRate(p), s));
      s = map * with_force;
    }
    tick.col(column) = s;
  }
  return tick.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

Drive::Drive(const Parameters& parameters, double period, RandomStream noise)
    : parameters_(parameters),
      noise_(std::move(noise)),
      samples_(samplesIn(period)),
      map_(sampleMap(parameters, period / samples_)) {}

void Drive::place(const Vec3& x) noexcept {
  x_ = x;
  v_.setZero();
  r_.setZero();
  stopAtEnds();
}

void Drive::advance(const Hold& hold) noexcept {
  const double servo = servoRate(parameters_), range = parameters_.max_force;
  for (int i = 0; i < samples_; ++i) {
    hand_force_ = hold.hand.stiffness * (hold.target - x_) + hold.hand.damping * (hold.target_velocity - v_) +
                  hold.force - hold.hand.mass * servo * (r_ - v_);
    Vec3 measured = hand_force_.cwiseMax(-range).cwiseMin(range);
    if (parameters_.noise > 0) {
      for (int axis = 0; axis < 3; ++axis) measured[axis] += parameters_.noise * noise_.normal();
    }
    step(measured + rendered_);
  }
}

void Drive::step(const Vec3& force) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 next = map_ * Eigen::Vector4d(x_[axis], v_[axis], r_[axis], force[axis]);
    x_[axis] = next[0], v_[axis] = next[1], r_[axis] = next[2];
  }
  for (Vec3* speed : {&r_, &v_}) {
    if (const double norm = speed->norm(); norm > parameters_.max_speed) *speed *= parameters_.max_speed / norm;
  }
  stopAtEnds();
}

// An end stop removes the velocity towards it, of the grip and of the virtual mass.
void Drive::stopAtEnds() noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const double from = parameters_.centre[axis] - parameters_.half_travel[axis];
    const double to = parameters_.centre[axis] + parameters_.half_travel[axis];
    if (x_[axis] >= from && x_[axis] <= to) continue;
    const double outward = x_[axis] > to ? 1 : -1;
    x_[axis] = std::clamp(x_[axis], from, to);
    if (v_[axis] * outward > 0) v_[axis] = 0;
    if (r_[axis] * outward > 0) r_[axis] = 0;
  }
}

double stiffestWall(const Parameters& parameters, const FingerImpedance& hand, double period) {
  const auto settles = [&](double stiffness) { return spectralRadius(parameters, hand, stiffness, period) < 1; };
  if (!settles(0)) return 0;
  double low = 0, high = 1000;
  while (settles(high) && high < 1e9) {
    low = high;
    high *= 2;
  }
  while (high - low > 1e-6 * high) (settles((low + high) / 2) ? low : high) = (low + high) / 2;
  return low;
}

}  // namespace presa::admittance
