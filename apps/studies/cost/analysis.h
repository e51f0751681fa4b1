#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/studies/cost/result.h"

/// Analysis of a study's results: Pareto front, gain per factor, the cheapest settings.
namespace presa::cost {

/// Pareto front of error and cost: indices of the outcomes that no other outcome beats in both, by rising cost. Errors
/// below the reference's resolution count as equal to it.
using CostOf = Spread (Outcome::*)() const;
std::vector<std::size_t> paretoFront(const Result& result, const std::string& metric,
                                     CostOf cost = &Outcome::perSecond);

/// Distance of the default setting from the Pareto front, as ratios; 1: on the front.
struct FrontDistance {
  double cost = 1;              ///< its cost over the cost of the cheapest setting at least as accurate
  double error = 1;             ///< its error over the error of the most accurate setting that costs no more
  std::size_t as_accurate = 0;  ///< index of that cheapest setting
  std::size_t as_cheap = 0;     ///< index of that most accurate setting
  /// The smaller of the two ratios; if one of them is 1, the other.
  double ratio() const { return cost > 1 && error > 1 ? std::min(cost, error) : std::max(cost, error); }
};
/// Distance of the default, among the settings with its engine; other engines do not support fingers and serve only for
/// comparison. No value when the default has no error or cost in this metric.
std::optional<FrontDistance> distanceToFront(const Result& result, const std::string& metric);
/// A default farther than this from the front, in cost and in error, should be replaced.
inline constexpr double kNearFront = 1.3;

/// Effect of changing one factor from its default to another value.
struct FactorGain {
  std::string factor, from, to;
  double cost_ratio = 1;   ///< ratio of processor time
  double error_ratio = 1;  ///< below 1: more accurate
  /// Extrapolated error ratio for twice the cost along this factor; no value when the cost does not change measurably.
  std::optional<double> per_double_cost;
};
std::vector<FactorGain> factorGains(const Result& result, const std::string& metric);

/// Index of the cheapest setting whose error is below `limit`.
std::optional<std::size_t> cheapestBelow(const Result& result, const std::string& metric, double limit);

/// Index of the cheapest setting below the just-noticeable difference in every metric that has one.
std::optional<std::size_t> cheapestUnfelt(const Result& result);

/// Observed order of convergence: minus the least-squares slope of log(error) over log(value) of a numeric factor, with
/// all other factors at their defaults.
std::optional<double> observedOrder(const Result& result, const std::string& metric, const std::string& factor);

/// The sentences at the end of the report: at most one per rule.
std::vector<std::string> sentences(const Result& result);

/// Number and unit, such as "0.0123 N".
std::string withUnit(double value, const std::string& unit);

}  // namespace presa::cost
