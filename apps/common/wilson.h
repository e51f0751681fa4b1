#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace presa {

/// A share of trials, with the 95 % interval of Wilson (1927).
struct Share {
  double value = 0, low = 0, high = 1;
};

/// `count` of `of` trials; of > 0.
inline Share shareOf(std::size_t count, std::size_t of) {
  const double n = static_cast<double>(of), p = static_cast<double>(count) / n, z = 1.959964;
  const double middle = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace presa
