#include "devices/scripted/finger_plant.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

// exp(A) by scaling and squaring of its Taylor series: |A| / 2^s <= 0.5 and 20 terms leave < 1e-16.
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
  // state (x, v, u), u the constant force
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

double dampingBound(double contact_stiffness, double period) noexcept { return contact_stiffness * period / 2; }

double automaticDamping(const FingerImpedance& impedance, double contact_stiffness, double period) noexcept {
  constexpr double kMargin = 2;     // on the bound: the object moves too, and the hand is not alone in the loop
  constexpr double kRatio = 0.7;    // of critical: no overshoot that would strike the object
  return std::max(kMargin * dampingBound(contact_stiffness, period),
                  2 * kRatio * std::sqrt(impedance.stiffness * impedance.mass));
}

}  // namespace presa
