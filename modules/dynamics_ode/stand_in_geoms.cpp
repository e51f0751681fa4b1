#include "modules/dynamics_ode/stand_in_geoms.h"

#include <algorithm>
#include <cmath>

#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {
namespace {

constexpr double kStandInRounding = 1e-6;

Pose poseOf(dGeomID geom) {
  dQuaternion q;
  dGeomGetQuaternion(geom, q);
  return {toVec3(dGeomGetPosition(geom)), toQuat(q)};
}

}  // namespace

GrownGeom::GrownGeom(dGeomID geom, double margin)
    : geom_(geom), shape_(dGeomGetClass(geom)), margin_(margin), X_WG_(poseOf(geom)) {
  switch (shape_) {
    case dBoxClass:
      dGeomBoxGetLengths(geom, size_);
      break;
    case dSphereClass:
      size_[0] = dGeomSphereGetRadius(geom);
      break;
    case dCylinderClass:
      dGeomCylinderGetParams(geom, &size_[0], &size_[1]);
      break;
    default:
      dGeomCapsuleGetParams(geom, &size_[0], &size_[1]);
  }
  set(margin);
}

void GrownGeom::set(double margin) {
  switch (shape_) {
    case dBoxClass:
      return dGeomBoxSetLengths(geom_, size_[0] + 2 * margin, size_[1] + 2 * margin, size_[2] + 2 * margin);
    case dSphereClass:
      return dGeomSphereSetRadius(geom_, size_[0] + margin);
    case dCylinderClass:
      return dGeomCylinderSetParams(geom_, size_[0] + margin, size_[1] + 2 * margin);
    default:
      dGeomCapsuleSetParams(geom_, size_[0] + margin, size_[1]);
  }
}

// Measure of how far a point lies outside the grown shape, zero on its surface; monotonic, but not a distance.
double GrownGeom::outside(const Vec3& p) const {
  switch (shape_) {
    case dBoxClass:
      return (p.cwiseAbs() - toVec3(size_) / 2).maxCoeff() - margin_;
    case dCylinderClass:
      return std::max(p.head<2>().norm() - size_[0], std::abs(p.z()) - size_[1] / 2) - margin_;
    default:
      return (p - Vec3(0, 0, std::clamp(p.z(), -size_[1] / 2, size_[1] / 2))).norm() - size_[0] - margin_;
  }
}

Vec3 GrownGeom::onTrueShape(const Vec3& p) const {
  switch (shape_) {
    case dBoxClass: {
      const Vec3 half = toVec3(size_) / 2;
      return p.cwiseMax(-half).cwiseMin(half);
    }
    case dCylinderClass: {
      const double r = p.head<2>().norm(), shrink = r > size_[0] ? size_[0] / r : 1;
      return {shrink * p.x(), shrink * p.y(), std::clamp(p.z(), -size_[1] / 2, size_[1] / 2)};
    }
    default: {  // a sphere swept along a line, possibly of length 0
      const Vec3 centre(0, 0, std::clamp(p.z(), -size_[1] / 2, size_[1] / 2));
      return centre + size_[0] * (p - centre).normalized();
    }
  }
}

// ODE places a contact on either surface or halfway between. Of these candidates the outermost that is not outside the
// grown shape lies on it. (ODE's round caps are octagons, 8 % too wide.)
void GrownGeom::takeBack(Vec3& p_W, double& depth, const Vec3& outward_W) const {
  const Vec3 p = X_WG_.inverseTimes(p_W), outward = X_WG_.q.conjugate() * outward_W;
  const double allowed = std::max(0.0, outside(p)) + kStandInRounding * margin_;
  Vec3 on_grown = p;
  for (const double part : {0.5, 1.0}) {
    const Vec3 other = p + part * depth * outward;
    if (outside(other) < allowed) on_grown = other;
  }
  const Vec3 on_true = onTrueShape(on_grown);
  depth -= (on_grown - on_true).dot(outward);
  p_W = X_WG_ * on_true;
}

namespace {

constexpr double kNotParallel = 1e-13;  // edges at a smaller angle, but not 0, confuse ODE [rad]
constexpr double kTurn = 1e-11;         // rotation of the stand-in about kAxis [rad]
const Vec3 kAxis(0.62, 0.41, 0.67);

bool nearlyParallel(dGeomID a, dGeomID b) {
  const dReal *A = dGeomGetRotation(a), *B = dGeomGetRotation(b);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double cos = std::abs(A[i] * B[j] + A[4 + i] * B[4 + j] + A[8 + i] * B[8 + j]);
      if (cos > 0 && cos < kNotParallel) return true;
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
