#pragma once
#include <string>
#include <vector>

#include "framework/scene/world.h"
#include "modules/view_osg/view_frame.h"

/// Displayed values of each finger, computed from the states. No drawing here.
namespace presa::view {

inline constexpr double kArrowLengthPerNewton = 0.010;  ///< [m/N]
inline constexpr double kLongestArrow = 10;             ///< [m]
inline constexpr double kPenLength = 0.12;              ///< of a tool whose device measures its orientation [m]

struct FingerView {
  std::string role;
  bool valid = false;  ///< the device delivers usable samples
  ContactMode mode = ContactMode::kNone;
  std::int32_t body = kNoBody;
  double radius = 0;      ///< fingertip radius, or that of a ball around the tool [m]
  bool oriented = false;  ///< the device measures the tool's orientation
  Quat q_WT = Quat::Identity();
  bool has_volume = false;      ///< a tool: its mesh is drawn at X_WT instead of a fingertip
  Pose X_WT;                    ///< of the tool, held off the bodies
  Pose X_WT_wanted;             ///< of the tool, where the hand wants it
  bool lies = false;            ///< the tool was put down
  Vec3 p_WH = Vec3::Zero();     ///< HIP [m]
  Vec3 p_WP = Vec3::Zero();     ///< proxy, relative to the body as drawn [m]
  Vec3 p_WC = Vec3::Zero();     ///< touched point, relative to the body as drawn [m]
  Vec3 nhat_W = Vec3::UnitZ();  ///< unit normal, body into finger
  Vec3 f_H_W = Vec3::Zero();    ///< rendered force on the finger [N]
  Vec3 t_H_W = Vec3::Zero();    ///< rendered torque on the tool about the HIP [N m]
  double normal_force = 0;      ///< rendered [N]
  double commanded_normal = 0;  ///< normal part of the force that goes to the device, after the output stage [N]
  double tangential_force = 0;  ///< [N], >= 0
  double friction = 0;          ///< current coefficient: static while sticking, dynamic while slipping
  double friction_static = 0;
  double force_limit = 0;  ///< force limit of the device role [N]

  bool touches() const noexcept { return mode != ContactMode::kNone && body != kNoBody; }
  /// The force has an arrow: neither too small to be seen nor no number.
  bool isPushed() const noexcept;
  /// Where it begins: at the contact, or, where an effect of the scene pushes, at the fingertip [m].
  const Vec3& forceBegin() const noexcept { return touches() ? p_WC : p_WP; }
  /// Where it ends [m].
  Vec3 forceEnd() const { return forceBegin() + kArrowLengthPerNewton * f_H_W; }
  /// Used fraction of the friction cone: tangential / (friction * normal); 0 without contact, 1 while slipping.
  double frictionUse() const noexcept;
};

/// Contact points are placed relative to the body poses in `frame`, so that a fingertip never floats off a moving
/// surface.
std::vector<FingerView> fingerViews(const World& world, const ViewFrame& frame);

/// The same without anything measured: free fingertips where they are seen, whatever they feel.
std::vector<FingerView> withoutMeasured(std::vector<FingerView> fingers);

/// Grip force on the body gripped hardest, as commanded to the devices [N]: half of the normal forces that cancel,
/// (sum |n| - |sum n|) / 2. Two opposed fingers of n newton give n; one finger gives 0.
double gripForce(const std::vector<FingerView>& fingers);
/// The largest grip force that devices with these force limits can give [N].
double maxGripForce(const std::vector<DeviceRole>& roles);

}  // namespace presa::view
