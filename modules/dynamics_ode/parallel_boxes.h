#pragma once
#include <ode/ode.h>

namespace presa::ode {

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
