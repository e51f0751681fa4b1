#include "modules/dynamics_ode/parallel_boxes.h"

#include <cmath>

#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {
namespace {

constexpr double kRounding = 1e-13;  // edges at a smaller angle, but not 0, confuse ODE [rad]
constexpr double kTurn = 1e-11;      // rotation of the stand-in about kAxis [rad]
const Vec3 kAxis(0.62, 0.41, 0.67);

bool nearlyParallel(dGeomID a, dGeomID b) {
  const dReal *A = dGeomGetRotation(a), *B = dGeomGetRotation(b);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double cos = std::abs(A[i] * B[j] + A[4 + i] * B[4 + j] + A[8 + i] * B[8 + j]);
      if (cos > 0 && cos < kRounding) return true;
    }
  }
  return false;
}

}  // namespace

dGeomID ParallelBoxes::standIn(dGeomID geom, dGeomID other) {
  if (dGeomGetClass(geom) != dBoxClass || dGeomGetClass(other) != dBoxClass || !nearlyParallel(geom, other))
    return geom;
  dVector3 edges;
  dGeomBoxGetLengths(geom, edges);
  dGeomBoxSetLengths(twin_, edges[0], edges[1], edges[2]);
  const dReal* p = dGeomGetPosition(geom);
  dGeomSetPosition(twin_, p[0], p[1], p[2]);
  dQuaternion q;
  dGeomGetQuaternion(geom, q);
  const Vec3 turn = kTurn / 2 * kAxis;
  dGeomSetQuaternion(twin_, toOde(toQuat(q) * Quat(1, turn.x(), turn.y(), turn.z())).data());
  return twin_;
}

}  // namespace presa::ode
