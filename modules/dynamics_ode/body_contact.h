#pragma once
#include <cstdint>

#include "framework/core/math/spatial.h"

namespace presa::ode {

/// One contact between two bodies. Convention of Presa: unit normal from A into B, depth >= 0 when overlapping,
/// forces listed act on B. B always moves; A may be fixed.
struct BodyContact {
  std::int32_t A = -1, B = -1;  ///< indices into Scene::bodies
  Vec3 p_W = Vec3::Zero();      ///< [m]
  Vec3 nhat_AB_W = Vec3::UnitZ();
  double depth = 0;  ///< [m]; negative: a gap that the two may close within the step
};

/// Room that is made at the start; where a body has more contacts than these, memory is taken once, when they come.
inline constexpr std::size_t kContactsPerBody = 16;

}  // namespace presa::ode
