#pragma once
#include <cstdint>

#include "framework/core/math/spatial.h"

namespace presa::ode {

/// One contact between two bodies. Presa's convention: unit normal from A into B, depth >= 0 when overlapping, forces
/// act on B. B is always a free body; A may be fixed.
struct BodyContact {
  std::int32_t A = -1, B = -1;  ///< indices into Scene::bodies
  Vec3 p_W = Vec3::Zero();      ///< [m]
  Vec3 nhat_AB_W = Vec3::UnitZ();
  double depth = 0;  ///< [m]; negative: a gap that the two may close within the step or soon after
};

/// Contacts per body for which memory is reserved at the start; more contacts allocate once.
inline constexpr std::size_t kContactsPerBody = 16;

}  // namespace presa::ode
