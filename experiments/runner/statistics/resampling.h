#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "experiments/runner/statistics/interval.h"
#include "framework/core/math/random.h"

/// Inference for dependent trials, many per person. Seeded: the same stream gives the same result. Thread: any.
namespace presa::statistics {

/// Interval between the quantiles (1 - level) / 2 and (1 + level) / 2 of bootstrap draws; at least one draw, 0 < level
/// < 1.
std::optional<Interval> percentileInterval(std::span<const double> draws, double level);

struct PermutationTest {
  double rho = 0;        ///< Spearman's rho of all cases pooled
  double p = 1;          ///< two-sided: (1 + hits) / (1 + shuffles), never 0 [Phipson & Smyth 2010]
  std::size_t hits = 0;  ///< shuffles at least as far from the expectation under shuffling as the data
  std::size_t shuffles = 0;
};

/// Permutation test: shuffles y within each stratum (any labels: subject, or subject and block), since only trials of
/// one stratum are exchangeable. A stratum with a single trial stays as it is. Nullopt where spearman() has no result,
/// when labels are missing, or for 0 shuffles.
std::optional<PermutationTest> spearmanPermutation(std::span<const double> x, std::span<const double> y,
                                                   std::span<const int> strata, std::size_t shuffles,
                                                   RandomStream& random);

constexpr std::size_t kFewestSubjects = 8;  ///< with fewer, resampled subjects say nothing about a population

struct SubjectBootstrap {
  std::optional<Interval> interval;  ///< none: see why_not
  const char* why_not = "";          ///< in words, empty when there is an interval
  std::size_t subjects = 0;
  std::size_t draws = 0;
  std::size_t undefined = 0;  ///< draws without a value of the statistic; excluded from the interval
};

/// A statistic of the listed trials; a trial is listed as often as its subject was drawn.
using TrialStatistic = std::function<std::optional<double>(std::span<const std::size_t> trials)>;

/// Percentile interval over subjects drawn with replacement, each with all its trials; `subjects` has one label per
/// trial. Slightly narrow for few subjects: a nominal 95 % interval of a mean covers 89 % with 8 subjects, 93 % with
/// 20.
SubjectBootstrap bootstrapSubjects(std::span<const int> subjects, const TrialStatistic& statistic, std::size_t draws,
                                   double level, RandomStream& random);

}  // namespace presa::statistics
