#pragma once
#include "framework/grasp/grasp.h"

namespace presa {

/// Bound of the normal forces that fingers can give together.
enum class GripBound {
  kSum,   ///< all normal forces add up to at most 1 N: L1 in [FerrariCanny1992]
  kEach,  ///< each is at most its own max_normal: L-infinity
};

/// The set of wrenches that the contacts can exert on the body with bounded normal forces: convex, contains 0. Known by
/// its support function, which is exact for round friction cones. Thread: any.
class WrenchSpace {
 public:
  WrenchSpace(const GraspSnapshot& grasp, GripBound bound);

  /// max of u . w over all wrenches w of the space; `point` gets a wrench that attains it.
  double support(const Vec6& u, Vec6& point) const;

  /// max of u . w over the wrenches of contacts that press with 1 N in all, without the choice to let go: negative when
  /// the contacts cannot but work against u.
  double pressing(const Vec6& u, Vec6& point) const;

  /// Orthonormal basis, one column each, of the wrenches that the contacts can exert together. Fewer than six columns:
  /// some wrench cannot be resisted however hard the fingers press. Directions below a millionth of the widest do not
  /// count.
  Eigen::Matrix<double, 6, Eigen::Dynamic> span() const;

 private:
  double ofContact(const GraspContact& contact, const Vec6& u, Vec6& point) const;

  GraspSnapshot grasp_;
  GripBound bound_;
};

}  // namespace presa
