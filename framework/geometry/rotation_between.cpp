#include "framework/geometry/rotation_between.h"

namespace presa {

Quat rotationBetween(const Vec3& from, const Vec3& to) noexcept { return Quat::FromTwoVectors(from, to); }

}  // namespace presa
