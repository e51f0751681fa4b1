#pragma once
#include <string>
#include <vector>

#include "framework/scene/world.h"
#include "modules/view_osg/view_frame.h"

/// What the picture says about each finger, worked out once from the states. No drawing here.
namespace presa::view {

inline constexpr double kArrowLengthPerNewton = 0.010;  ///< [m/N]

struct FingerView {
  std::string role;
  bool valid = false;  ///< its device delivers samples
  ContactMode mode = ContactMode::kNone;
  std::int32_t body = kNoBody;
  double radius = 0;            ///< fingertip [m]
  Vec3 p_WH = Vec3::Zero();     ///< HIP
  Vec3 p_WP = Vec3::Zero();     ///< proxy, on the body as drawn
  Vec3 p_WC = Vec3::Zero();     ///< touched point, on the body as drawn
  Vec3 nhat_W = Vec3::UnitZ();  ///< body into finger
  Vec3 f_H_W = Vec3::Zero();    ///< rendered force on the finger [N]
  double normal_force = 0;      ///< [N]
  double tangential_force = 0;  ///< [N], >= 0
  double friction = 0;          ///< coefficient that bounds it now: static in stick, dynamic in slip
  double friction_static = 0;
  double force_limit = 0;  ///< of the device role [N]

  bool touches() const noexcept { return mode != ContactMode::kNone && body != kNoBody; }
  /// Share of the friction cone in use: tangential / (friction * normal); 0 without contact. 1: it slips.
  double frictionUse() const noexcept;
};

/// Contact points ride on the bodies as `frame` poses them, so that a fingertip never floats off a moving surface.
std::vector<FingerView> fingerViews(const World& world, const ViewFrame& frame);

/// The squeeze on the body gripped hardest [N]: half of what the normal forces cancel, (sum |n| - |sum n|) / 2. Two
/// opposed fingers of n newton give n, one finger gives 0 however hard it pushes.
double gripForce(const std::vector<FingerView>& fingers);

}  // namespace presa::view
