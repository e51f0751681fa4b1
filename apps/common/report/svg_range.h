#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace presa::svg {

/// Range of the finite values that were added; low > high: none were.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Wider by that share of itself, at both ends.
  Range widened(double share) const {
    const double margin = high > low ? share * (high - low) : std::max(1e-9, 0.1 * std::abs(high));
    return {low - margin, high + margin};
  }
};

}  // namespace presa::svg
