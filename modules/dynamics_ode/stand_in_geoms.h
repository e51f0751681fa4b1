#pragma once
#include <ode/ode.h>

#include "framework/core/math/spatial.h"

namespace presa::ode {

/// Enlarges a box, sphere, cylinder or capsule by `margin` on all sides while this object exists, so that nearby shapes
/// touch it. A contact of the grown shape, projected back to the true one, has the gap as negative depth.
class GrownGeom {
 public:
  static bool possible(dGeomID geom) noexcept { return geom != nullptr && dGeomGetClass(geom) != dTriMeshClass; }

  GrownGeom(dGeomID geom, double margin);
  ~GrownGeom() { set(0); }
  GrownGeom(const GrownGeom&) = delete;
  GrownGeom& operator=(const GrownGeom&) = delete;

  /// Converts a contact of the grown shape to one of the true shape: p_W on its surface, negative depth for a gap.
  /// `outward_W` is the unit normal of the contact, pointing out of this shape.
  void takeBack(Vec3& p_W, double& depth, const Vec3& outward_W) const;

 private:
  void set(double margin);
  double outside(const Vec3& p_G) const;
  Vec3 onTrueShape(const Vec3& p_G) const;

  dGeomID geom_;
  int shape_;
  double margin_;
  dVector3 size_{};  ///< true size; box: edge lengths; others: radius, length
  Pose X_WG_;
};

/// Workaround for ODE's box-box collision, which uses the cross product of two edges as a separating axis even when it
/// is only rounding. For boxes in contact with axes parallel to 1e-16 but not to the last bit (a cube that rolled onto
/// another side) it misses one contact in 50, step after step, and the boxes sink into each other. A box rotated by
/// 1e-11 rad is detected reliably.
class ParallelBoxes {
 public:
  ParallelBoxes() : twin_(dCreateBox(nullptr, 1, 1, 1)) {}
  ~ParallelBoxes() { dGeomDestroy(twin_); }
  ParallelBoxes(const ParallelBoxes&) = delete;
  ParallelBoxes& operator=(const ParallelBoxes&) = delete;

  /// The geometry to collide with `other` in place of `geom`: `geom` itself or a rotated copy, valid until the next
  /// call.
  dGeomID standIn(dGeomID geom, dGeomID other);

 private:
  dGeomID twin_;
};

}  // namespace presa::ode
