#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

/// Joints of a scene over time, from the poses of its bodies alone. Whoever has the scene and the poses knows the
/// joints: a run, a viewer over the bus, a recording.
namespace presa {

/// Number of positions: one per axis; of a ball one, the angle from the start pose; of a fixed joint none.
std::size_t positionCount(const Joint& joint) noexcept;
/// Whether position i is an angle [rad]; else a distance [m].
bool isAngle(const Joint& joint, std::size_t i) noexcept;

/// Whether a joint holds the body, index into Scene::bodies.
bool isJoined(const std::vector<Joint>& joints, std::size_t body);

/// How far a joint is open in the directions that it locks. 0 where the joint holds exactly.
struct JointOpening {
  double distance = 0;  ///< [m]
  double angle = 0;     ///< [rad]
};
JointOpening openingOf(const Joint& joint, const JointPose& pose) noexcept;  ///< opening of a joint in `pose`

/// Follows every joint of a scene. Angles of axes go on beyond half a turn, as long as less than half a turn lies
/// between two calls. Allocates in the constructor only.
class JointMotion {
 public:
  /// `scene` must outlive this.
  explicit JointMotion(const Scene& scene);

  std::size_t count() const noexcept { return states_.size(); }                  ///< joints of the scene
  const Joint& joint(std::size_t j) const noexcept { return scene_.joints[j]; }  ///< j as in Scene::joints
  /// `poseOfBody(i)`: pose X_WB of body i of the scene.
  template <class PoseOfBody>
  void follow(const PoseOfBody& poseOfBody) {
    for (std::size_t j = 0; j < count(); ++j) {
      const Joint& one = joint(j);
      place(j, poseOfBody(one.body), one.to == Joint::kWorld ? Pose{} : poseOfBody(one.to));
    }
  }
  /// The next angles lie within half a turn of these positions, joint by joint; none: of 0. After a jump in time.
  void goOnFrom(const std::vector<double>& positions = {}) noexcept;

  /// Position i of joint j [m, rad]; 0 in the start pose.
  double position(std::size_t j, std::size_t i) const noexcept { return states_[j].position[i]; }
  /// J in `body` against J in `to`.
  const JointPose& pose(std::size_t j) const noexcept { return states_[j].pose; }
  /// Constant, from the start poses.
  const JointFrames& frames(std::size_t j) const noexcept { return states_[j].frames; }

 private:
  struct State {
    JointFrames frames;
    JointPose pose;
    std::array<double, Joint::kMaxAxes> position{};
  };
  void place(std::size_t j, const Pose& X_WB, const Pose& X_WA) noexcept;

  const Scene& scene_;
  std::vector<State> states_;
};

}  // namespace presa
