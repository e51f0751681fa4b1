#include "modules/view_osg/camera_choice.h"

#include <cmath>
#include <numbers>

namespace presa::view {

std::optional<CameraPose> CameraChoice::place() const {
  if (!asked_ || !std::holds_alternative<CameraPlace>(*asked_)) return std::nullopt;
  const CameraPlace& place = std::get<CameraPlace>(*asked_);
  return CameraPose{place.eye, place.target};
}

CameraChoice::Direction CameraChoice::direction(const std::vector<Ball>& subject) const {
  constexpr double kQuarter = std::numbers::pi / 2;
  const double diagonal = std::atan(std::numbers::sqrt2 / 2);  // the elevation of (1, 1, 1)
  if (!asked_ || !std::holds_alternative<ViewSide>(*asked_)) return {chooseHeading(subject), elevation_};
  switch (std::get<ViewSide>(*asked_)) {
    case ViewSide::kFront:
      return {0, 0};
    case ViewSide::kBack:
      return {2 * kQuarter, 0};
    case ViewSide::kLeft:
      return {-kQuarter, 0};
    case ViewSide::kRight:
      return {kQuarter, 0};
    case ViewSide::kTop:
      return {0, kQuarter};
    case ViewSide::kIso:
      return {kQuarter / 2, diagonal};
  }
  return {chooseHeading(subject), elevation_};
}

Vec3 upOf(const CameraPose& pose) {
  const Vec3 forward = pose.target - pose.eye;
  return std::hypot(forward.x(), forward.y()) < 1e-6 * forward.norm() ? Vec3::UnitY() : Vec3::UnitZ();
}

}  // namespace presa::view
