#include "modules/view_osg/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace presa::view {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kUsedHeight = 0.80;  ///< fraction of the picture's height for the subject

/// Constraint on the eye from two planes through it, with slope `slope` to either side of the axis, that enclose all
/// balls.
struct Wedge {
  double back;   ///< foremost position of the eye along the axis [m]
  double aside;  ///< its position across the axis then [m]
};
// A ball at c of radius r lies on the inner side of the plane when (c - e).across + r / cos <= (c - e).forward * slope.
Wedge fit(const std::vector<Ball>& balls, const Vec3& across, const Vec3& forward, double slope) {
  const double secant = std::hypot(1, slope);
  double high = -1e300, low = -1e300;
  for (const Ball& ball : balls) {
    const double depth = slope * ball.center.dot(forward), aside = ball.center.dot(across);
    high = std::max(high, aside + secant * ball.radius - depth);
    low = std::max(low, -aside + secant * ball.radius - depth);
  }
  return {-(high + low) / (2 * slope), (high - low) / 2};
}

double spread(const std::vector<Ball>& balls, const Vec3& right) {
  double low = 1e300, high = -1e300;
  for (const Ball& ball : balls) {
    low = std::min(low, ball.center.dot(right));
    high = std::max(high, ball.center.dot(right));
  }
  return high - low;
}

}  // namespace

Ball enclose(const std::vector<Ball>& balls) {
  if (balls.empty()) return {Vec3::Zero(), 0.2};
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  for (const Ball& ball : balls) {
    low = low.cwiseMin(ball.center - Vec3::Constant(ball.radius));
    high = high.cwiseMax(ball.center + Vec3::Constant(ball.radius));
  }
  Ball all{(low + high) / 2, 0.02};
  for (const Ball& ball : balls) all.radius = std::max(all.radius, (ball.center - all.center).norm() + ball.radius);
  return all;
}

double chooseHeading(const std::vector<Ball>& balls) {
  const auto rightOf = [](double heading) { return Vec3(std::cos(heading), std::sin(heading), 0); };
  constexpr double kFront = 12 * kDegree, kSide = 78 * kDegree;
  return spread(balls, rightOf(kSide)) > spread(balls, rightOf(kFront)) ? kSide : kFront;
}

CameraAxes::CameraAxes(double heading, double elevation)
    : right(std::cos(heading), std::sin(heading), 0),
      up(-std::sin(elevation) * std::sin(heading), std::sin(elevation) * std::cos(heading), std::cos(elevation)),
      forward(-std::cos(elevation) * std::sin(heading), std::cos(elevation) * std::cos(heading), -std::sin(elevation)) {
}

CameraPose frameSubject(const std::vector<Ball>& balls, double aspect, double heading, double used_width,
                        double elevation) {
  const Ball all = enclose(balls);
  std::vector<Ball> seen = balls;
  seen.push_back({all.center, 0.02});
  const CameraAxes axes(heading, elevation);
  const double slope = std::tan(kFieldOfView / 2 * kDegree);
  const Wedge height = fit(seen, axes.up, axes.forward, kUsedHeight * slope);
  const Wedge width = fit(seen, axes.right, axes.forward, used_width * aspect * slope);
  const double back = std::min(height.back, width.back);
  const Vec3 eye = back * axes.forward + height.aside * axes.up + width.aside * axes.right;
  return {eye, eye + (all.center - eye).dot(axes.forward) * axes.forward};
}

double reachInPicture(const std::vector<Ball>& balls, const CameraPose& pose, double aspect, double used_width) {
  const Vec3 forward = (pose.target - pose.eye).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized(), up = right.cross(forward);
  const double slope = std::tan(kFieldOfView / 2 * kDegree);
  const double height = kUsedHeight * slope, width = used_width * aspect * slope;
  double reach = 0;
  for (const Ball& ball : balls) {
    const Vec3 p = ball.center - pose.eye;
    const double depth = p.dot(forward);
    if (depth <= ball.radius) return std::numeric_limits<double>::infinity();
    const auto slopeTo = [&](double aside) { return (std::abs(aside) + ball.radius) / depth; };
    reach = std::max({reach, slopeTo(p.dot(up)) / height, slopeTo(p.dot(right)) / width});
  }
  return reach;
}

}  // namespace presa::view
