#pragma once
#include <span>

#include "devices/assembling_hand/grasp.h"
#include "devices/assembling_hand/surroundings.h"

namespace presa::assembling {

/// The body to take next, its grasp, and its goal.
struct Choice {
  std::size_t goal = 0, body = 0;
  Grasp grasp;
  bool only_moves = false;  ///< move it to free space, turned by hanging, and take it again from there
  bool tips_over = false;   ///< then tip it over: for a flat body on its head, which hangs from its side
  double effort = 0;
};

/// Previous attempts with a body.
struct Trial {
  int count = 0;
  Vec3 a_B = Vec3::Zero();  ///< line of the last grasp
  bool only_moves = false;
  bool placed = false;  ///< at its goal, not to be moved
  int stuck = 0;        ///< consecutive failed lifts in which neighbours held it: the next grip is harder
};

/// Chooses the next action of min effort. Thread: any; no allocation after construction.
class Chooser {
 public:
  /// `fingertip`: radius [m]; `opening`: gap between finger and body before closing [m].
  Chooser(const World& world, double fingertip, double opening);

  /// The best action to bring `body` to `goal`, which may be to move an obstacle first. The pair is at `p_W` with
  /// direction `yaw` [rad]. `trials` is indexed by body; failed attempts are repeated last.
  Choice weigh(const ObjectState& objects, std::size_t goal, std::size_t body, const Vec3& p_W, double yaw,
               std::span<const Trial> trials) const noexcept;
  const Surroundings& surroundings() const noexcept { return surroundings_; }

  /// Min height of the fingers' centres above the ground, in fingertip radii.
  static constexpr double kOverGround = 1.05;

 private:
  void pressHarder(Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept;
  void takeLow(Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept;
  struct Obstacles {
    int fingers = 0;                             ///< number of blocked fingers
    std::size_t first = Surroundings::kNothing;  ///< one blocking body
  };
  void weighCarrying(Choice& best, std::size_t& in_the_way, const ObjectState& objects, double effort, double yaw,
                     std::span<const Trial> trials) const noexcept;
  void weighMoving(Choice& best, const ObjectState& objects, std::size_t goal, std::size_t body, double effort,
                   double yaw, std::span<const Trial> trials) const noexcept;
  Obstacles obstacles(const ObjectState& objects, const Grasp& grasp, std::size_t body,
                      const Pose& X_WB) const noexcept;

  const World& world_;
  const Surroundings surroundings_;
  const double fingertip_, opening_;
};

}  // namespace presa::assembling
