#pragma once
#include <ode/ode.h>

#include <array>

#include "framework/core/math/spatial.h"

/// Conversions between ODE's arrays and Presa's types. Both: SI units, vectors in W, quaternions w x y z.
namespace presa::ode {

inline Vec3 toVec3(const dReal* v) { return {v[0], v[1], v[2]}; }
inline Quat toQuat(const dReal* q) { return {q[0], q[1], q[2], q[3]}; }
inline std::array<dReal, 4> toOde(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }
inline void assign(dReal* to, const Vec3& from) {
  to[0] = from.x();
  to[1] = from.y();
  to[2] = from.z();
}

}  // namespace presa::ode
