#pragma once
#include <span>
#include <vector>

namespace presa::statistics {

/// Ranks 1 … n in the order of the values; equal values (==) share the mean of the ranks they take up, so that the sum is
/// always n (n + 1) / 2. Infinities rank as numbers do; a NaN gets rank NaN and takes up none.
std::vector<double> midRanks(std::span<const double> values);

/// Values that belong to one factor level but were computed in different ways (m g / 2 / mu, m / (2 mu) g) differ in their
/// last bits, and a rank would tell them apart. Gives all that lie within `tolerance` (relative) above
/// the smallest of their group that smallest value; rank the result. NaN stays NaN.
std::vector<double> toLevels(std::span<const double> values, double tolerance = 1e-9);

}  // namespace presa::statistics
