#pragma once
#include <ode/ode.h>

namespace presa::ode {

/// ODE takes the cross product of two edges for a separating axis even where it is nothing but rounding. Of boxes that lie on each
/// other with axes parallel to 1e-16 but not to the last bit (a cube that rolled on another side), it then misses one contact
/// in 50, step after step, and lets them fall through each other. Turned by 1e-11 rad they are what they were, and found.
class ParallelBoxes {
 public:
  ParallelBoxes() : twin_(dCreateBox(nullptr, 1, 1, 1)) {}
  ~ParallelBoxes() { dGeomDestroy(twin_); }
  ParallelBoxes(const ParallelBoxes&) = delete;
  ParallelBoxes& operator=(const ParallelBoxes&) = delete;

  /// What to collide with `other` in place of `geom`: itself, or such a box. Good until the next call.
  dGeomID standIn(dGeomID geom, dGeomID other);

 private:
  dGeomID twin_;
};

}  // namespace presa::ode
