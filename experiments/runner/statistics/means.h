#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiments/runner/statistics/interval.h"

/// Means, quantiles and their intervals, in the unit of the values. Nullopt when there are too few values or one is not
/// finite: remove missing values first, so that a report states the n that was used. Thread: any.
namespace presa::statistics {

bool allFinite(std::span<const double> values);

/// n >= 1. Two passes, so that a large common offset costs no precision.
std::optional<double> mean(std::span<const double> values);
/// Sample standard deviation (n - 1); n >= 2.
std::optional<double> standardDeviation(std::span<const double> values);
/// Linear between order statistics (type 7 of [Hyndman & Fan 1996], the default of R and numpy); n >= 1, p in [0, 1].
std::optional<double> quantile(std::span<const double> values, double p);
std::optional<double> median(std::span<const double> values);

struct MeanEstimate {
  std::size_t n = 0;
  double mean = 0, sd = 0;
  Interval interval;  ///< mean +- t((1 + level) / 2, n - 1) sd / sqrt n; between subjects if values are per subject
};
/// n >= 2, 0 < level < 1.
std::optional<MeanEstimate> meanInterval(std::span<const double> values, double level = 0.95);

/// One value of one subject in one condition; labels are arbitrary.
struct LabelledValue {
  int subject = 0, condition = 0;
  double value = 0;
};

struct WithinSubjectIntervals {
  struct Condition {
    int condition = 0;
    double mean = 0;    ///< mean of the subjects' means
    Interval interval;  ///< for differences between conditions: differences between subjects are removed
  };
  std::size_t subjects = 0;
  double correction = 1;              ///< sqrt(M / (M - 1)) for M conditions: state it wherever the interval is drawn
  std::vector<Condition> conditions;  ///< by ascending label
};
/// [Cousineau 2005] with the correction of [Morey 2008]: each subject's mean per condition, minus that subject's mean
/// over all conditions, plus the grand mean; then a t interval per condition over the N subjects with sd times the
/// correction. Nullopt with fewer than two subjects or conditions, or when a subject misses a condition.
std::optional<WithinSubjectIntervals> withinSubjectIntervals(std::span<const LabelledValue> values,
                                                             double level = 0.95);

}  // namespace presa::statistics
