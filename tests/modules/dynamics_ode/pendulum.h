#pragma once
#include <cmath>
#include <numbers>

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

}  // namespace presa::ode
