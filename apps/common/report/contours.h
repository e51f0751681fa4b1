#pragma once
#include <vector>

#include "apps/common/report/svg_plot.h"

namespace presa::svg {

/// The lines along which heights over a grid have a value, by marching squares: straight across each cell. z of (x[i], y[j])
/// at [j * x.size() + i]; cells with a corner that is NaN have none. Axes ascending.
std::vector<std::vector<Point>> contours(const std::vector<double>& x, const std::vector<double>& y,
                                         const std::vector<double>& z, double level);

}  // namespace presa::svg
