#pragma once
#include <span>
#include <vector>

namespace presa::statistics {

/// Ranks 1 … n in ascending order; equal values (==) share the mean of their ranks, so the sum is always n (n + 1) / 2.
/// Infinities rank like numbers; a NaN gets rank NaN and is not counted in n.
std::vector<double> midRanks(std::span<const double> values);

/// Removes rounding differences between values of one factor level that were computed in different ways (m g / 2 / mu,
/// m / (2 mu) g) and would otherwise get different ranks. Values within the relative `tolerance` above the smallest of
/// their group become that smallest value; rank the result. NaN stays NaN.
std::vector<double> toLevels(std::span<const double> values, double tolerance = 1e-9);

}  // namespace presa::statistics
