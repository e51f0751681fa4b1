// The plant is discretised exactly by a matrix exponential, so its energy is that of the continuous system at any rate.
// The damping bound of a held object is found by bisection on the spectral radius of the closed loop over one dynamics
// step.
#include "devices/hand/finger_plant.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace presa {
namespace {

// exp(A) by scaling and squaring of its Taylor series: |A| / 2^s <= 0.5, and 20 terms leave an error < 1e-16.
Mat3 exponential(Mat3 a) {
  int squarings = 0;
  while (a.cwiseAbs().rowwise().sum().maxCoeff() > 0.5) {
    a /= 2;
    ++squarings;
  }
  Mat3 sum = Mat3::Identity(), term = Mat3::Identity();
  for (int i = 1; i <= 20; ++i) {
    term = term * a / i;
    sum += term;
  }
  for (int i = 0; i < squarings; ++i) sum = sum * sum;
  return sum;
}

}  // namespace

FingerPlant::FingerPlant(const FingerImpedance& impedance, double period)
    : stiffness_(impedance.stiffness), damping_(impedance.damping) {
  // state (x, v, u), where u is the constant force
  Mat3 a = Mat3::Zero();
  a(0, 1) = 1;
  a(1, 0) = -stiffness_ / impedance.mass;
  a(1, 1) = -damping_ / impedance.mass;
  a(1, 2) = 1 / impedance.mass;
  const Mat3 e = exponential(a * period);
  xx_ = e(0, 0), xv_ = e(0, 1), xu_ = e(0, 2);
  vx_ = e(1, 0), vv_ = e(1, 1), vu_ = e(1, 2);
}

void FingerPlant::step(const Vec3& p_WT, const Vec3& v_WT, const Vec3& f) noexcept {
  const Vec3 u = stiffness_ * p_WT + damping_ * v_WT + f;
  const Vec3 x = xx_ * x_ + xv_ * v_ + xu_ * u;
  v_ = vx_ * x_ + vv_ * v_ + vu_ * u;
  x_ = x;
}

double wallDampingBound(double contact_stiffness, double period) noexcept { return contact_stiffness * period / 2; }

namespace {

// Spectral radius of finger and massless object over one dynamics step, in one dimension.
double spectralRadius(const FingerImpedance& impedance, double contact_stiffness, double period,
                      double dynamics_period) {
  // state at a dynamics tick: finger x, v; object position; finger x, v one haptic tick ago (the newest sample of
  // dynamics)
  using State = Eigen::Matrix<double, 5, 1>;
  const int ticks = static_cast<int>(std::lround(dynamics_period / period));
  const FingerPlant at_rest(impedance, period);
  Eigen::Matrix<double, 5, 5> map;
  for (int column = 0; column < 5; ++column) {
    State s = State::Unit(column);
    FingerPlant plant = at_rest;
    plant.reset({s[0], 0, 0}, {s[1], 0, 0});
    const double from = s[2], to = s[3] + (period + dynamics_period) * s[4];
    for (int i = 0; i < ticks; ++i) {
      s[3] = plant.position().x(), s[4] = plant.velocity().x();
      const double object = from + (to - from) * i / ticks;
      plant.step(Vec3::Zero(), Vec3::Zero(), {contact_stiffness * (object - plant.position().x()), 0, 0});
    }
    map.col(column) << plant.position().x(), plant.velocity().x(), to, s[3], s[4];
  }
  return map.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

double heldObjectDampingBound(const FingerImpedance& impedance, double contact_stiffness, double period,
                              double dynamics_period) {
  const auto settles = [&](double damping) {
    FingerImpedance damped = impedance;
    damped.damping = damping;
    return spectralRadius(damped, contact_stiffness, period, dynamics_period) < 1;
  };
  constexpr double kNone = 1e-6;  // [N s/m]: a finger that settles with less needs no damping
  double low = 0, high = 1;
  while (!settles(high) && high < 1e6) {
    low = high;
    high *= 2;
  }
  while (high > kNone && high - low > 1e-3 * high) (settles((low + high) / 2) ? high : low) = (low + high) / 2;
  return high > kNone ? high : 0;
}

double automaticDamping(const FingerImpedance& impedance, double contact_stiffness, double period,
                        double dynamics_period) {
  constexpr double kWallMargin = 2;    // friction and output limits act in the loop too
  constexpr double kHeldMargin = 1.5;  // visible decay instead of marginal stability
  constexpr double kRatio = 0.7;       // damping ratio: no overshoot that would strike the object
  return std::max({kWallMargin * wallDampingBound(contact_stiffness, period),
                   kHeldMargin * heldObjectDampingBound(impedance, contact_stiffness, period, dynamics_period),
                   2 * kRatio * std::sqrt(impedance.stiffness * impedance.mass)});
}

}  // namespace presa
