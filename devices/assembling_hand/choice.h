#pragma once
#include <span>

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

/// What was tried with a body so far.
struct Trial {
  int count = 0;
  Vec3 a_B = Vec3::Zero();  ///< the last grasp's line
  bool only_moves = false;
  bool placed = false;  ///< stands where it belongs, and is left there
  int stuck = 0;        ///< how often in a row it stayed where it was: neighbours hold it, and it is taken the harder
};

/// Weighs what two fingers would have to put up with. Thread: any one; no memory after construction.
class Chooser {
 public:
  /// `fingertip`: radius, `opening`: what they keep beside a body before they close [m].
  Chooser(const World& world, double fingertip, double opening);

  /// The best way to bring `body` to `goal`, be it by moving first what is in the way; the pair is at `p_W` and points to `yaw`.
  /// `trials`, by body: what was in vain is tried again last.
  Choice weigh(const ObjectState& objects, std::size_t goal, std::size_t body, const Vec3& p_W, double yaw,
               std::span<const Trial> trials) const noexcept;
  const Surroundings& surroundings() const noexcept { return surroundings_; }

  /// How high the fingers' centres are when they take something: over the ground, in their radii.
  static constexpr double kOverGround = 1.05;

 private:
  void pressHarder(Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept;
  void takeLow(Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept;
  struct Obstacles {
    int fingers = 0;                             ///< that find something in their way
    std::size_t first = Surroundings::kNothing;  ///< a body of it
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
