// Inverse kinematics in closed form after Stamper, for one leg at a time; forward kinematics by Newton's method with
// step halving on the thigh angles (residual <= 1e-13 rad). Motor torques follow from the force by the transposed
// Jacobian and are scaled by one factor when a motor saturates, which keeps the direction of the force.
#include "devices/novint_falcon/kinematics.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace presa::falcon {
namespace {

// [m], named as in Stamper's thesis
constexpr double kThigh = 0.060;           // a
constexpr double kShin = 0.1025;           // b
constexpr double kPlatform = 0.01443;      // c
constexpr double kShinEnds = 2 * 0.01125;  // d + e: end pieces of the parallelogram
constexpr double kSideOffset = -0.025;     // f
constexpr double kBaseRadius = 0.0400;     // r
constexpr double kBaseSide = -0.02309;     // s

constexpr double kRadian = std::numbers::pi / 180;
constexpr std::array<double, 3> kAzimuths{105 * kRadian, -15 * kRadian, -135 * kRadian};

// 320 slots in quadrature per motor turn; the motor's capstan drives a sector
constexpr double kAnglePerCount = 2 * std::numbers::pi / (320 * 4) * (0.01425 / 0.110);
constexpr double kAngleAtZero = 35 * kRadian;

constexpr double kResidual = 1e-13;  // [rad]
constexpr int kMaxIterations = 30;
constexpr int kMaxHalvings = 12;

/// Rotation from the device frame into each leg's frame.
const std::array<Mat3, 3> kToLeg = [] {
  std::array<Mat3, 3> turns;
  for (std::size_t i = 0; i < 3; ++i) turns[i] = Eigen::AngleAxisd(-kAzimuths[i], Vec3::UnitZ()).toRotationMatrix();
  return turns;
}();

/// One leg with its foot at (u, v, w) in its own frame: side swing theta3 and thigh angle theta1.
struct Leg {
  double u = 0, w = 0;         // from the hip to the foot, in the plane of the thigh
  double length = 0;           // of the shin, projected onto that plane
  double swing_cotangent = 0;  // of theta3
  double thigh = 0;            // theta1
};

std::optional<Leg> legAt(const Vec3& p_DH, std::size_t index) noexcept {
  const Vec3 foot = kToLeg[index] * p_DH + Vec3(-kBaseRadius, -kBaseSide, 0);
  Leg leg;
  leg.u = foot.x() + kPlatform;
  leg.w = foot.z();
  const double side = foot.y() + kSideOffset;
  const double reach = kShin * kShin - side * side;  // (b sin theta3)^2
  if (!(reach > 0)) return {};
  leg.length = kShinEnds + std::sqrt(reach);
  leg.swing_cotangent = side / std::sqrt(reach);
  const double distance = std::hypot(leg.u, leg.w);
  const double cosine = (distance * distance + kThigh * kThigh - leg.length * leg.length) / (2 * kThigh * distance);
  if (!(std::abs(cosine) <= 1)) return {};
  leg.thigh = std::atan2(leg.w, leg.u) - std::acos(cosine);
  return leg;
}

/// d(theta1)/d(foot), from the derivative of the closure (u - a cos)^2 + (w - a sin)^2 = L(v)^2.
std::optional<Vec3> gradientOf(const Leg& leg) noexcept {
  const double c = std::cos(leg.thigh), s = std::sin(leg.thigh);
  const double lever = kThigh * (leg.u * s - leg.w * c);
  // zero where thigh and shin are aligned; a lever below 0.1 mm counts as stretched
  if (!(std::abs(lever) > 1e-4 * kThigh)) return {};
  return Vec3(leg.u - kThigh * c, leg.length * leg.swing_cotangent, leg.w - kThigh * s) / -lever;
}

struct Solution {
  ThighAngles angles;
  Mat3 jacobian;
};

std::optional<Solution> solve(const Vec3& p_DH) noexcept {
  Solution solution;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto leg = legAt(p_DH, i);
    if (!leg) return {};
    const auto gradient = gradientOf(*leg);
    if (!gradient) return {};
    const auto row = static_cast<Eigen::Index>(i);
    solution.angles[row] = leg->thigh;
    solution.jacobian.row(row) = gradient->transpose() * kToLeg[i];
  }
  return solution;
}

/// Newton's method; halves the step while it leaves the reach or does not reduce the residual.
std::optional<Vec3> search(const ThighAngles& wanted, Vec3 p_DH) noexcept {
  auto here = solve(p_DH);
  if (!here) return {};
  double residual = (here->angles - wanted).cwiseAbs().maxCoeff();
  for (int i = 0; i < kMaxIterations; ++i) {
    if (residual <= kResidual) return p_DH;
    Vec3 step = here->jacobian.inverse() * (here->angles - wanted);
    if (!step.allFinite()) return {};
    bool closer = false;
    for (int h = 0; h < kMaxHalvings && !closer; ++h, step /= 2) {
      const Vec3 there = p_DH - step;
      const auto next = solve(there);
      if (!next) continue;
      const double next_residual = (next->angles - wanted).cwiseAbs().maxCoeff();
      if (!(next_residual < residual)) continue;
      p_DH = there, here = next, residual = next_residual, closer = true;
    }
    if (!closer) return {};
  }
  return {};
}

}  // namespace

ThighAngles thighAngles(const Counts& encoders) noexcept {
  return kAngleAtZero * Vec3::Ones() + kAnglePerCount * Vec3(encoders[0], encoders[1], encoders[2]);
}

std::optional<ThighAngles> inverse(const Vec3& p_DH) noexcept {
  ThighAngles angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto leg = legAt(p_DH, i);
    if (!leg) return {};
    angles[static_cast<Eigen::Index>(i)] = leg->thigh;
  }
  return angles;
}

std::optional<Mat3> inverseJacobian(const Vec3& p_DH) noexcept {
  const auto solution = solve(p_DH);
  if (!solution) return {};
  return solution->jacobian;
}

std::optional<Vec3> direct(const ThighAngles& angles, const Vec3& start) noexcept {
  if (!angles.allFinite()) return {};
  if (start.allFinite()) {
    if (auto found = search(angles, start)) return found;
  }
  return search(angles, kCentre);
}

std::optional<Counts> motorCounts(const Vec3& f_H_D, const Vec3& p_DH, int limit, double counts_per_torque) noexcept {
  const auto jacobian = inverseJacobian(p_DH);
  if (!f_H_D.allFinite() || !jacobian) return {};
  const double size = f_H_D.cwiseAbs().maxCoeff();
  if (size == 0) return Counts{};
  // normalise first, so that the largest double does not overflow
  const Vec3 per_newton = -counts_per_torque * (jacobian->transpose().inverse() * (f_H_D / size));
  const double peak = per_newton.cwiseAbs().maxCoeff();
  if (!std::isfinite(peak)) return {};
  const double scale = std::min(size, limit / peak);
  Counts counts{};
  for (std::size_t motor = 0; motor < 3; ++motor) {
    const double wanted = per_newton[static_cast<Eigen::Index>(motor)] * scale;
    if (!(std::abs(wanted) < limit + 0.5)) return {};
    counts[motor] = std::clamp(static_cast<std::int32_t>(std::lround(wanted)), -limit, limit);
  }
  return counts;
}

}  // namespace presa::falcon
