#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/spatial.h"

/// Joints between two bodies, or between a body and the world, as plain data. SI units and radians.
namespace presa {

/// Kinds of joint; nameOf gives each its word in a scene, Joint::axes says which axes it has.
enum class JointType { kFixed, kHinge, kSlider, kBall, kUniversal, kPrismaticRotary };

/// One degree of freedom of a joint. Its position is 0 in the start pose of the scene, and grows as `body` moves along
/// the axis, or turns about it, against `to`.
struct JointAxis {
  Vec3 dhat_B = Vec3::UnitZ();  ///< unit, in the frame of `body` at the start; of a ball: no meaning
  bool turns = true;            ///< [rad, N m], else [m, N]
  std::optional<double> lower,  ///< of the position, <= 0; none: no limit
      upper;                    ///< of the position, >= 0; none: no limit
  double stiffness = 0;         ///< of a spring towards `rest` [N/m, N m/rad]
  double rest = 0;              ///< position at which the spring is relaxed
  double damping = 0;           ///< [N s/m, N m s/rad]
  double friction = 0;          ///< Coulomb friction: max force against motion [N, N m]
  double speed = 0;             ///< that the motor tries to reach [m/s, rad/s]
  double max_force = 0;         ///< of the motor; 0: none [N, N m]

  bool hasSpring() const noexcept { return stiffness > 0 || damping > 0; }  ///< a spring or a damper acts on it
};

/// Holds `body` to `to`. All of it is consistent in the start pose of the scene: a joint says where it sits in `body`,
/// and where it sits in `to` follows.
struct Joint {
  static constexpr std::size_t kWorld = static_cast<std::size_t>(-1);  ///< `to` of a joint to the world
  static constexpr std::size_t kMaxAxes = 2;                           ///< degrees of freedom with an axis of their own

  std::string name;                    ///< unique among the joints of a scene (E203)
  JointType type = JointType::kHinge;  ///< says which axes it has
  std::size_t body = 0,                ///< index into Scene::bodies
      to = kWorld;                     ///< index into Scene::bodies, or kWorld
  Vec3 p_BJ = Vec3::Zero();            ///< in the frame of `body` [m]
  /// Hinge, slider: one. Universal: the first is fixed in `to`, the second, square to it, in `body`. Prismatic-rotary:
  /// slides along the first, fixed in `to`, and turns about the second. Ball: none, or one with friction and damping in
  /// all directions.
  std::vector<JointAxis> axes;
  bool collide = false;  ///< whether the two bodies collide with each other
  SourceLocation where;  ///< its element in the scene
};

/// The word for it in a scene.
const char* nameOf(JointType type);

/// The joint's frame J: origin at the joint, z along the first axis, x along the part of the second square to it. J is
/// fixed in both bodies and coincides at the start.
struct JointFrames {
  Pose X_BJ,  ///< in the frame of `body`
      X_AJ;   ///< in the frame A of `to`, or in W
};
/// From the start poses of `body` (X_WB) and `to` (X_WA; identity for the world).
JointFrames framesOf(const Joint& joint, const Pose& X_WB, const Pose& X_WA);

/// How J in `body` stands against J in `to`.
struct JointPose {
  Vec3 p_J = Vec3::Zero();      ///< displacement, in the axes of J in `to` [m]
  Quat q_J = Quat::Identity();  ///< rotation
};
/// From the poses of `body` and `to` now; identity where the joint is as at the start.
JointPose poseOf(const JointFrames& frames, const Pose& X_WB, const Pose& X_WA);

/// Position of axis i [m, rad]; angles in (-pi, pi]. Of a ball: the angle from the start pose.
double positionOf(const Joint& joint, std::size_t i, const JointPose& pose);

/// Direction of the second axis in J, as fixed in `body`; `joint` has two.
Vec3 secondAxis(const Joint& joint);

}  // namespace presa
