#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/studies/cost/result.h"

/// The front of error and cost: the one source of the drawn front, the tables, the verdict and the sentences.
namespace presa::cost {

/// A setting as one metric judges it.
struct Judged {
  std::size_t index = 0;  ///< into Result::outcomes
  Spread cost;            ///< processor time per simulated second
  double error = 0;       ///< Result::claimed, rounded to the three digits that the report prints
};

/// Costs closer than this, as a ratio, count as the same: timing repeats no better.
inline constexpr double kSameCost = 1.05;
/// The default is near the front when no setting beats it by more than this, neither in cost nor in error.
inline constexpr double kNearFront = 1.3;

/// Every setting that has an error in this metric and a cost, in the order of the outcomes.
std::vector<Judged> judged(const Result& result, const std::string& metric);
/// True when `a` costs less than `b`, the same, or within kSameCost of it.
bool noDearer(const Judged& a, const Judged& b);
/// True when `a` costs less than `b` by more than kSameCost and by more than the spread of the repeats of both.
bool cheaper(const Judged& a, const Judged& b);
/// True when `a` is more accurate and no dearer, or cheaper and as accurate. Never both beats(a, b) and beats(b, a).
bool beats(const Judged& a, const Judged& b);

/// True when the setting could replace the default: it has the default's engine, and no conditions. Other engines do not
/// support fingers and serve only for comparison.
bool comparable(const Result& result, std::size_t index);

/// The comparable settings that no comparable setting beats, by rising cost; errors do not rise along it.
std::vector<Judged> frontOf(const Result& result, const std::string& metric);

/// Distance of the default setting from the front, as ratios; 1: nothing beats it.
struct FrontDistance {
  double cost = 1;              ///< its cost over the cost of the cheapest setting that beats it in cost
  double error = 1;             ///< its error over the error of the most accurate setting that is no dearer
  std::size_t as_accurate = 0;  ///< index of that cheapest setting; 0: none
  std::size_t as_cheap = 0;     ///< index of that most accurate setting; 0: none
  /// The larger of the two: what the default gives away. 1 exactly when the default is on the front.
  double ratio() const { return cost > error ? cost : error; }
};
/// No value when the default has no error or cost in this metric.
std::optional<FrontDistance> distanceToFront(const Result& result, const std::string& metric);

/// Whether nobody feels an error of the setting, judged or not, where it is known what people feel; an error that is not
/// known counts as felt.
bool isUnfelt(const Result& result, std::size_t index);

/// Index of the cheapest setting without conditions, of any engine, whose error is below `limit`.
std::optional<std::size_t> cheapestBelow(const Result& result, const std::string& metric, double limit);
/// Index of the cheapest setting without conditions below the just-noticeable difference in every metric that has one.
std::optional<std::size_t> cheapestUnfelt(const Result& result);

}  // namespace presa::cost
