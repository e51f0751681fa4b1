#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/studies/cost/result.h"

/// What the numbers of a study say.
namespace presa::cost {

/// Indices of the outcomes that no other beats in both error and cost, by rising cost. Errors below the reference's
/// resolution count as equal to it.
using CostOf = Spread (Outcome::*)() const;
std::vector<std::size_t> paretoFront(const Result& result, const std::string& metric,
                                     CostOf cost = &Outcome::perSecond);

/// How far the default is from the front: 1 is on it.
struct FrontDistance {
  double cost = 1;              ///< its cost over that of the cheapest setting that is as accurate
  double error = 1;             ///< its error over that of the most accurate setting that costs no more
  std::size_t as_accurate = 0;  ///< index of that cheapest setting
  std::size_t as_cheap = 0;     ///< index of that most accurate setting
  /// The lesser way to the front; where one of the two is no way at all, because a cheaper setting is just as accurate or a
  /// more accurate one costs just as much, the other.
  double least() const { return cost > 1 && error > 1 ? std::min(cost, error) : std::max(cost, error); }
};
/// Against the settings of the default's own engine: the others know no fingers and are there to compare with.
/// Nothing when the default has no error or cost in this metric.
std::optional<FrontDistance> distanceToFront(const Result& result, const std::string& metric);
/// A default that is farther than this from the front, in cost and in error, should be another.
inline constexpr double kNearFront = 1.3;

/// What going from the default to one other value of one knob does.
struct KnobGain {
  std::string knob, from, to;
  double cost_ratio = 1;   ///< of processor time
  double error_ratio = 1;  ///< below 1: better
  /// Error for twice the cost over error now, along this knob; nothing where the cost does not measurably change.
  std::optional<double> per_double_cost;
};
std::vector<KnobGain> knobGains(const Result& result, const std::string& metric);

/// Index of the cheapest setting whose error is below `limit`.
std::optional<std::size_t> cheapestBelow(const Result& result, const std::string& metric, double limit);

/// Index of the cheapest setting below the just-noticeable difference in every metric that has one.
std::optional<std::size_t> cheapestUnfelt(const Result& result);

/// Least-squares slope of log(error) over log(value) of a numeric knob, all else as in the default, times -1.
std::optional<double> observedOrder(const Result& result, const std::string& metric, const std::string& knob);

/// The report's last words, one text per rule that has something to say.
std::vector<std::string> sentences(const Result& result);

/// "0.0123 N"
std::string withUnit(double value, const std::string& unit);

}  // namespace presa::cost
