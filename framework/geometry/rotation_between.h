#pragma once
#include "framework/core/math/spatial.h"

namespace presa {

/// The shortest rotation that turns the direction of `from` into that of `to`; both are not zero. Compiled once:
/// Eigen's template brings a singular value decomposition, five seconds in each file that uses it.
Quat rotationBetween(const Vec3& from, const Vec3& to) noexcept;

}  // namespace presa
