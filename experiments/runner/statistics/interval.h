#pragma once

namespace presa::statistics {

/// A closed interval, in the unit of the bounded quantity.
struct Interval {
  double low = 0, high = 0;
  bool contains(double value) const { return low <= value && value <= high; }
  double halfWidth() const { return 0.5 * (high - low); }
};

}  // namespace presa::statistics
