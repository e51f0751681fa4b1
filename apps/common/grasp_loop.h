#pragma once
#include <cstddef>
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// A free body between fingers, as a mass on their springs [PERCRO2006 3.2].
struct GraspLoop {
  std::size_t body = 0;     ///< index into Scene::bodies
  std::size_t fingers = 0;  ///< two or more
  double mass = 0;          ///< [kg]
  double stiffness = 0;     ///< of the body's surface under one finger [N/m]

  /// Along the grip, sqrt(n K / M) / (2 pi) [Hz].
  double naturalFrequency() const;
  /// Mass below which the grasp oscillates, if each step of the dynamics takes the force at its start: n K h^2 / 4 for
  /// symplectic Euler without delay, h^2 K / 2 for two fingers [kg]. `period`: h [s].
  double explicitMinMass(double period) const;
};

/// Below so many times explicitMinMass an explicit exchange of forces is a gamble: fingers have mass, arms bend, and a
/// finger feels the body up to one step late. Grasps that were run need 1.04 times (scripted fingers) to 2.8 times
/// (modelled arms, interpolated poses), at 0.5 to 2 N/mm.
inline constexpr double kExplicitMargin = 3;

GraspLoop graspLoop(const World& world, std::size_t body, std::size_t fingers);

/// The grasps of all of a scene's fingers on each free body that they can touch and that no joint holds; none with
/// fewer than two fingers.
std::vector<GraspLoop> graspLoops(const World& world);

}  // namespace presa
