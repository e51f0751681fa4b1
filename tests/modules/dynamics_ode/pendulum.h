#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace presa::ode {

/// Complete elliptic integral of the first kind by the arithmetic-geometric mean.
inline double ellipticK(double k) {
  double a = 1, b = std::sqrt(1 - k * k);
  for (int i = 0; i < 40; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::numbers::pi / 2 / a;
}

/// Top of the parabola through three equally spaced values.
inline double peakOf(double a, double b, double c) {
  const double slope = (c - a) / 2, bend = a - 2 * b + c;
  return b - slope * slope / (2 * bend);
}

/// What a swing shows: its mean period [s], and by how much the heights at which it turns differ [as `height`].
struct Swing {
  double period = 0, spread = 0;
};

/// `next()` makes a step of `h` [s] and returns the angle [rad] and the height at its end.
template <class Next>
Swing swingOver(int steps, double h, const Next& next) {
  std::vector<double> angles, heights, crossings, peaks;
  for (int i = 0; i < steps; ++i) {
    const auto [angle, height] = next();
    angles.push_back(angle);
    heights.push_back(height);
    const std::size_t n = angles.size();
    if (n < 3) continue;
    if (angles[n - 2] < 0 && angles[n - 1] >= 0)
      crossings.push_back(h * (static_cast<double>(n) - angles[n - 1] / (angles[n - 1] - angles[n - 2])));
    if (heights[n - 2] > heights[n - 3] && heights[n - 2] >= heights[n - 1])
      peaks.push_back(peakOf(heights[n - 3], heights[n - 2], heights[n - 1]));
  }
  const auto [lowest, highest] = std::ranges::minmax(peaks);
  return {(crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1), highest - lowest};
}

}  // namespace presa::ode
