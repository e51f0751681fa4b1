#pragma once
#include <optional>
#include <vector>

#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa::assembling {

/// Obstacle queries: each body counts as the box around its physics geometry. Thread: any; no allocation after
/// construction.
class Surroundings {
 public:
  explicit Surroundings(const World& world);

  /// A body other than `but` that intersects the ball, or kNothing.
  std::size_t bodyAt(const ObjectState& objects, const Vec3& p_W, double radius, std::size_t but) const noexcept;
  /// True if the body is outside the workspace field, from where it will be brought back.
  bool isOutOfReach(const ObjectState& objects, std::size_t body) const noexcept;
  /// The body that lies on `body`, or kNothing.
  std::size_t coverOf(const ObjectState& objects, std::size_t body) const noexcept;
  /// Offset from a goal pose X_WB at which `body` is best put down: slightly away from adjacent bodies, so that it does
  /// not catch on their edges; zero without neighbours or with neighbours on both sides [m].
  Vec3 awayFromNeighbours(const ObjectState& objects, std::size_t body, const Pose& X_WB) const noexcept;
  /// A place on the ground near `p_W` with room for `body` and the fingers around it; nullopt when there is none.
  std::optional<Vec3> roomFor(const ObjectState& objects, std::size_t body, const Vec3& p_W,
                              double fingertip) const noexcept;
  static constexpr std::size_t kNothing = static_cast<std::size_t>(-1);

 private:
  struct Bounds {
    bool solid = false, fixed = false;
    Pose X_BG;  ///< centre of the box, along its edges
    Vec3 half = Vec3::Zero();
    double radius = 0;  ///< of the bounding ball [m]
  };
  bool isRoom(const ObjectState& objects, const Vec3& p_W, double radius, std::size_t but) const noexcept;
  static Bounds boundsOf(const Body& body, const BodyMeshes& meshes);

  std::vector<Bounds> bounds_;  // by body
  std::optional<Assembly::Workspace> workspace_;
};

}  // namespace presa::assembling
