#include "experiments/runner/statistics/ranks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace presa::statistics {
namespace {

/// Indices of the values that are not NaN, in ascending order of value.
std::vector<std::size_t> ascending(std::span<const double> values) {
  std::vector<std::size_t> order;
  order.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

}  // namespace

std::vector<double> midRanks(std::span<const double> values) {
  std::vector<double> ranks(values.size(), std::numeric_limits<double>::quiet_NaN());
  const std::vector<std::size_t> order = ascending(values);
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double shared = 0.5 * static_cast<double>(first + 1 + end);
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = shared;
  }
  return ranks;
}

std::vector<double> toLevels(std::span<const double> values, double tolerance) {
  std::vector<double> levels(values.begin(), values.end());
  const std::vector<std::size_t> order = ascending(values);
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    const double smallest = values[order[first]];
    const auto belongs = [&](double value) {
      return value == smallest || (std::isfinite(value) && value - smallest <= tolerance * std::abs(value));
    };
    while (end < order.size() && belongs(values[order[end]])) levels[order[end++]] = smallest;
  }
  return levels;
}

}  // namespace presa::statistics
