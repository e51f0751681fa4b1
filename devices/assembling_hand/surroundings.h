#pragma once
#include <optional>
#include <vector>

#include "framework/scene/world.h"
#include "framework/core/state/object_state.h"

namespace presa::assembling {

/// Where bodies are in the way: each counts as the box about its physics geometry. Thread: any one; no memory after construction.
class Surroundings {
 public:
  explicit Surroundings(const World& world);

  /// A body other than `but` in that ball, or kNothing.
  std::size_t bodyAt(const ObjectState& objects, const Vec3& p_W, double radius, std::size_t but) const noexcept;
  /// Whether it is where nobody reaches it: out of the field, from where it is brought back.
  bool isOutOfReach(const ObjectState& objects, std::size_t body) const noexcept;
  /// What lies on `body`: another body, or kNothing.
  std::size_t coverOf(const ObjectState& objects, std::size_t body) const noexcept;
  /// From where `body` is best put to X_WB: a little away from those who stand right beside it there, so that it does not catch on
  /// their edges; zero where nobody does, or on both sides [m].
  Vec3 awayFromNeighbours(const ObjectState& objects, std::size_t body, const Pose& X_WB) const noexcept;
  /// A place on the ground for `body`, not far from `p_W`, where fingers have room around it; nothing when there is none.
  std::optional<Vec3> roomFor(const ObjectState& objects, std::size_t body, const Vec3& p_W,
                              double fingertip) const noexcept;
  static constexpr std::size_t kNothing = static_cast<std::size_t>(-1);

 private:
  struct Bounds {
    bool solid = false, fixed = false;
    Pose X_BG;  ///< middle of the box, along its edges
    Vec3 half = Vec3::Zero();
    double radius = 0;  ///< of the ball about it [m]
  };
  bool isRoom(const ObjectState& objects, const Vec3& p_W, double radius, std::size_t but) const noexcept;
  static Bounds boundsOf(const Body& body, const TriMesh* mesh);

  std::vector<Bounds> bounds_;  // by body
  std::optional<Assembly::Field> field_;
};

}  // namespace presa::assembling
