#pragma once

namespace presa::statistics {

/// Both ends belong to it; in the unit of what it bounds.
struct Interval {
  double low = 0, high = 0;
  bool contains(double value) const { return low <= value && value <= high; }
  double halfWidth() const { return 0.5 * (high - low); }
};

}  // namespace presa::statistics
