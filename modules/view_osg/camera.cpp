#include "modules/view_osg/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace presa::view {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kElevation = 26 * kDegree;
constexpr double kUsedHeight = 0.80;  ///< share of the picture's height for the subject
constexpr double kUsedWidth = 0.52;   ///< the head-up display takes the sides

/// From the subject to the eye, unit.
Vec3 towardsEye(double heading) {
  return {std::cos(kElevation) * std::sin(heading), -std::cos(kElevation) * std::cos(heading), std::sin(kElevation)};
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

CameraPose frameSubject(const std::vector<Ball>& balls, double aspect, double heading) {
  const Ball all = enclose(balls);
  const double half_height = kUsedHeight * kFieldOfView / 2 * kDegree;
  const double half_width = std::atan(kUsedWidth * aspect * std::tan(kFieldOfView / 2 * kDegree));
  const double distance = all.radius / std::sin(std::min(half_height, half_width));
  return {all.center + distance * towardsEye(heading), all.center};
}

}  // namespace presa::view
