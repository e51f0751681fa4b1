#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiments/runner/statistics/interval.h"

/// Means, quantiles and their intervals, in the unit of the values. No result (nullopt) when there are fewer values than
/// said or one of them is not finite: leave out what a trial did not give before, so that the n in a report is the n used.
/// Thread: any.
namespace presa::statistics {

bool allFinite(std::span<const double> values);

/// n >= 1; exact to rounding whatever the offset of the values.
std::optional<double> mean(std::span<const double> values);
/// With n - 1; n >= 2.
std::optional<double> standardDeviation(std::span<const double> values);
/// Linear between order statistics (type 7 of [Hyndman & Fan 1996], the default of R and numpy); n >= 1, p in [0, 1].
std::optional<double> quantile(std::span<const double> values, double p);
std::optional<double> median(std::span<const double> values);

struct MeanEstimate {
  std::size_t n = 0;
  double mean = 0, sd = 0;
  Interval interval;  ///< mean +- t((1 + level) / 2, n - 1) sd / sqrt n: between subjects when values are of subjects
};
/// n >= 2, 0 < level < 1.
std::optional<MeanEstimate> meanInterval(std::span<const double> values, double level = 0.95);

/// One value of one subject under one condition; any labels.
struct LabelledValue {
  int subject = 0, condition = 0;
  double value = 0;
};

struct WithinSubjectIntervals {
  struct Condition {
    int condition = 0;
    double mean = 0;  ///< of the subjects' means
    Interval
        interval;  ///< for differences between conditions: what subjects have in common with themselves is taken out
  };
  std::size_t subjects = 0;
  double correction = 1;              ///< sqrt(M / (M - 1)), M conditions: to be named wherever the interval is drawn
  std::vector<Condition> conditions;  ///< by ascending label
};
/// [Cousineau 2005] with the correction of [Morey 2008]: every subject's mean per condition, less his mean over all
/// conditions, plus the grand mean; t interval of each condition over the N subjects with sd times the correction. No result
/// with fewer than two subjects or conditions, or when a subject misses a condition.
std::optional<WithinSubjectIntervals> withinSubjectIntervals(std::span<const LabelledValue> values,
                                                             double level = 0.95);

}  // namespace presa::statistics
