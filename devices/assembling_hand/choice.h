#pragma once
#include "devices/assembling_hand/grasp.h"
#include "devices/assembling_hand/surroundings.h"

namespace presa::assembling {

/// Which body to take next, how, and for which place.
struct Choice {
  std::size_t goal = 0, body = 0;
  Grasp grasp;
  bool only_moves = false;  ///< to where there is room, turned by hanging, to be taken again from there
  bool tips_over = false;   ///< and there laid on its back: a flat body on its head, which hangs from its side
  double effort = 0;
};

/// Weighs what two fingers would have to put up with. Thread: any one; no memory after construction.
class Chooser {
 public:
  /// `fingertip`: radius, `opening`: what they keep beside a body before they close [m].
  Chooser(const World& world, double fingertip, double opening);

  /// The best way to bring `body` to `goal`, be it by moving what lies on it first; the pair is at `p_W` and points to `yaw`.
  Choice weigh(const ObjectState& objects, std::size_t goal, std::size_t body, const Vec3& p_W,
               double yaw) const noexcept;
  const Surroundings& surroundings() const noexcept { return surroundings_; }

  /// How high the fingers' centres are when they take something: over the ground, in their radii.
  static constexpr double kOverGround = 1.05;

 private:
  void takeLow(Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept;
  void weighCarrying(Choice& best, const ObjectState& objects, double effort, double yaw) const noexcept;
  void weighMoving(Choice& best, const ObjectState& objects, std::size_t goal, std::size_t body, double effort,
                   double yaw) const noexcept;
  double obstacles(const ObjectState& objects, const Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept;

  const World& world_;
  const Surroundings surroundings_;
  const double fingertip_, opening_;
};

}  // namespace presa::assembling
