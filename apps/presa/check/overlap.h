#pragma once
#include <vector>

#include "framework/scene/world.h"

namespace presa::check {

/// Two bodies that overlap where a scene starts.
struct Overlap {
  std::size_t first = 0, second = 0;  ///< indices into Scene::bodies, first < second
  double depth = 0;                   ///< the shortest way that parts them [m]
  Vec3 nhat_W = Vec3::UnitZ();        ///< in which the second must move
};

/// Pairs of bodies, not both fixed, whose physics geometries overlap by more than `tolerance` [m]. Exact for boxes; of
/// round shapes and convex pieces the depth is found to better than a hundredth. A concave mesh that is used as it is
/// counts as nothing: what lies in its hollow does not overlap it. Thread: main.
std::vector<Overlap> overlapsOf(const World& world, double tolerance);

}  // namespace presa::check
