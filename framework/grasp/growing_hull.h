#pragma once
#include <functional>
#include <vector>

#include "framework/grasp/quality.h"

namespace presa {

using WrenchBasis = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// A half space that bounds the hull: the wrenches x inside of it have normal . x <= offset; all within the span.
struct HullFacet {
  Eigen::VectorXd normal;  ///< unit length, in coordinates of the basis
  double offset = 0;
};

/// The figure that one facet or supporting half space (same fields) allows; the smallest over all is wanted. Infinity:
/// it allows any.
using FacetFigure = std::function<double(const Eigen::VectorXd& normal, double offset)>;

struct HullFigure {
  ProvenBounds bounds;
  Eigen::VectorXd normal;  ///< of the half space that sets the upper bound
};

/// Lower and upper bound of the smallest figure over all supporting half spaces of the space, in the basis of its span.
/// A hull of wrenches of the space is inside of it and gives the lower bound; at each facet that is too low, the hull
/// grows by the space's own wrench in the facet's direction, and the support there gives the upper bound.
HullFigure smallestFigure(const WrenchSpace& space, const WrenchBasis& basis, const FacetFigure& figure);

}  // namespace presa
