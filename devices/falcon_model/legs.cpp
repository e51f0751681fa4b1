#include "devices/falcon_model/legs.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace presa::falcon_model {
namespace {

constexpr double kThigh = 0.060, kShin = 0.1025, kTube = 2 * 0.01125;  // [m]
constexpr double kMotorRadius = 0.0400, kMotorAcross = -0.02309;       // of the motor axes, from the centre [m]
constexpr double kGripAlong = 0.01443, kGripAcross = -0.025;           // end of the shin, from the grip's centre [m]
constexpr double kDeg = 0.017453292519943295;
constexpr std::array kAzimuth{105 * kDeg, -15 * kDeg, -135 * kDeg};

/// End of a leg's shin, relative to the motor axis: u outwards in the motor's plane, y across, w along D's z.
struct End {
  double u, y, w;
};

End endOf(const Vec3& p_D, std::size_t leg) {
  const double cos = std::cos(kAzimuth[leg]), sin = std::sin(kAzimuth[leg]);
  return {cos * p_D.x() + sin * p_D.y() - kMotorRadius + kGripAlong,
          -sin * p_D.x() + cos * p_D.y() - kMotorAcross + kGripAcross, p_D.z()};
}

/// Implicit function of a leg's torus, zero on it, with its derivatives.
struct Torus {
  double value;
  Vec3 by_grip;     // in D
  double by_thigh;  // [per rad]
};

Torus torusOf(const Vec3& p_D, double thigh, std::size_t leg) {
  const End end = endOf(p_D, leg);
  const double from_knee_u = end.u - kThigh * std::cos(thigh), from_knee_w = end.w - kThigh * std::sin(thigh);
  const double distance = std::hypot(from_knee_u, from_knee_w), tube = distance - kTube;
  const double by_u = 2 * tube * from_knee_u / distance, by_w = 2 * tube * from_knee_w / distance, by_y = 2 * end.y;
  const double cos = std::cos(kAzimuth[leg]), sin = std::sin(kAzimuth[leg]);
  return {tube * tube + end.y * end.y - kShin * kShin,
          {cos * by_u - sin * by_y, sin * by_u + cos * by_y, by_w},
          kThigh * (by_u * std::sin(thigh) - by_w * std::cos(thigh))};
}

}  // namespace

std::optional<Vec3> thighsAt(const Vec3& p_D) {
  Vec3 thighs;
  for (const std::size_t leg : {0UL, 1UL, 2UL}) {
    const End end = endOf(p_D, leg);
    const double square = kShin * kShin - end.y * end.y;
    if (!(square >= 0)) return std::nullopt;
    // the knee: intersection of the thigh's circle with the circle around the shin's end
    const double reach = kTube + std::sqrt(square), far = std::hypot(end.u, end.w);
    const double along = (kThigh * kThigh + far * far - reach * reach) / (2 * far);
    const double across2 = kThigh * kThigh - along * along;
    if (!(across2 >= 0)) return std::nullopt;
    const double across = std::sqrt(across2);
    // of the two solutions, the knee that is bent outwards
    thighs[static_cast<int>(leg)] = std::atan2(along * end.w - across * end.u, along * end.u + across * end.w);
  }
  return thighs;
}

Mat3 thighRates(const Vec3& p_D, const Vec3& thighs) {
  Mat3 rates;
  for (const std::size_t leg : {0UL, 1UL, 2UL}) {
    const int row = static_cast<int>(leg);
    const Torus torus = torusOf(p_D, thighs[row], leg);
    rates.row(row) = -torus.by_grip.transpose() / torus.by_thigh;
  }
  return rates;
}

std::optional<Vec3> gripAt(const Vec3& thighs, const Vec3& near_D) {
  Vec3 p_D = near_D;
  for (int i = 0; i < 50; ++i) {
    Vec3 value;
    Mat3 slope;
    for (const std::size_t leg : {0UL, 1UL, 2UL}) {
      const Torus torus = torusOf(p_D, thighs[static_cast<int>(leg)], leg);
      value[static_cast<int>(leg)] = torus.value;
      slope.row(static_cast<int>(leg)) = torus.by_grip.transpose();
    }
    const Vec3 step = slope.fullPivLu().solve(value);
    if (!step.allFinite()) return std::nullopt;
    p_D -= step;
    if (step.norm() < 1e-14) return p_D;
  }
  return std::nullopt;
}

}  // namespace presa::falcon_model
