#pragma once
#include <vector>

#include "apps/common/report/svg_plot.h"

namespace presa::svg {

/// Contour lines of heights over a grid by marching squares: straight across each cell. z of (x[i], y[j]) is at
/// [j * x.size() + i]; cells with a NaN corner have no line. Axes ascending.
std::vector<std::vector<Point>> contours(const std::vector<double>& x, const std::vector<double>& y,
                                         const std::vector<double>& z, double level);

}  // namespace presa::svg
