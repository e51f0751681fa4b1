#pragma once
#include <array>

#include "framework/scene/world.h"
#include "framework/core/state/object_state.h"

namespace presa::assembling {

/// Where two fingertips take a body: on a level line, pushing towards each other.
struct Grasp {
  Vec3 p_BC = Vec3::Zero();  ///< middle between the touched points, body frame [m]
  Vec3 a_B = Vec3::UnitX();  ///< from thumb to index, body frame
  double half = 0;           ///< half the width of the body there [m]
  double force = 0;          ///< of each finger [N]
};

inline constexpr double kMostGrip = 6;  ///< of each finger [N]

/// Half of what a physics geometry measures along the unit direction `n_G`, in its own frame [m].
double halfWidth(const Shape& shape, const TriMesh* mesh, const Vec3& n_G);
/// The same of body `i`, along `n_B` in the body's frame.
double halfWidth(const World& world, std::size_t i, const Vec3& n_B);

/// From the centre of mass of body `i` out to its skin, along the unit direction `n_B`; a mesh counts as convex [m].
double outTo(const World& world, std::size_t i, const Vec3& n_B);

/// Cosine between a body's top and straight up, above which it stands; below its negative it is on its head.
inline constexpr double kStands = 0.9;

/// A few level lines.
struct Lines {
  static constexpr std::size_t kMost = 4;
  std::array<Vec3, kMost> a_W;
  std::size_t count = 0;
  void add(const Vec3& n_W) { a_W[count++] = Vec3(n_W.x(), n_W.y(), 0).normalized(); }
};

/// Along which body `i`, which is at X_WB and whose top is `up_B`, may be taken to have its top up in the end. One that lies swings upright
/// about the line, which leaves one; one that stands is taken across its sides, a round one from anywhere (the first along `yaw` [rad]).
Lines linesToHang(const World& world, std::size_t i, const Pose& X_WB, const Vec3& up_B, double yaw);
/// Along which it may be taken to be moved as it lies.
Lines linesToMove(const World& world, std::size_t i, const Pose& X_WB);

/// How to take body `i` along the line `a_W`, so that `top_B` is up when it hangs (zero: by its middle). The thumb is on the side where that of a pair that points to
/// `yaw` is [rad].
Grasp graspAlong(const World& world, std::size_t i, const Pose& X_WB, const Vec3& top_B, const Vec3& a_W, double yaw);

}  // namespace presa::assembling
