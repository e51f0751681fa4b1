#pragma once
#include <array>

#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa::assembling {

/// A grasp of a body by two fingertips that push towards each other along a level line.
struct Grasp {
  Vec3 p_BC = Vec3::Zero();  ///< midpoint between the contact points, body frame [m]
  Vec3 a_B = Vec3::UnitX();  ///< from thumb to index, unit, body frame
  double half = 0;           ///< half the width of the body along the line [m]
  double force = 0;          ///< of each finger [N]
};

inline constexpr double kMaxGrip = 6;  ///< max force of each finger [N]

/// Half the extent of a physics geometry along the unit direction `n_G`, in the geometry's frame [m].
double halfWidth(const Shape& shape, const TriMesh* mesh, const Vec3& n_G);
/// Same for body `i` along `n_B`, in the body's frame.
double halfWidth(const World& world, std::size_t i, const Vec3& n_B);

/// Distance from the centre of mass of body `i` to its surface along the unit direction `n_B` [m]; meshes count as
/// convex.
double outTo(const World& world, std::size_t i, const Vec3& n_B);

/// Min cosine between a body's top and the vertical at which it counts as standing; below the negative value it is on
/// its head.
inline constexpr double kStands = 0.9;

/// Up to kCapacity level unit directions.
struct Lines {
  static constexpr std::size_t kCapacity = 4;
  std::array<Vec3, kCapacity> a_W;
  std::size_t count = 0;
  void add(const Vec3& n_W) { a_W[count++] = Vec3(n_W.x(), n_W.y(), 0).normalized(); }
};

/// Grasp lines for body `i` at X_WB with top direction `up_B`, such that it hangs with its top up. A lying body swings
/// upright about the line, which leaves one; a standing body is grasped across its sides, a cylinder along any of
/// kCapacity directions (the first along `yaw` [rad]).
Lines linesToHang(const World& world, std::size_t i, const Pose& X_WB, const Vec3& up_B, double yaw);
/// Grasp lines for moving body `i` without turning it, narrowest first.
Lines linesToMove(const World& world, std::size_t i, const Pose& X_WB);

/// Grasp of body `i` along the line `a_W`, such that it hangs with `top_B` up (zero: grasp its middle). The thumb is on
/// the side where the thumb of a pair with direction `yaw` [rad] is.
Grasp graspAlong(const World& world, std::size_t i, const Pose& X_WB, const Vec3& top_B, const Vec3& a_W, double yaw);

}  // namespace presa::assembling
