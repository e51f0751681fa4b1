// Permutation test: Spearman's rho is a monotone function of the product sum of the ranks, so only that sum is
// recomputed per shuffle. p = (1 + hits) / (1 + shuffles) [Phipson & Smyth 2010]. Bootstrap: subjects are drawn with
// replacement, each with all of its trials, and the interval lies between percentiles of the draws.
#include "experiments/runner/statistics/resampling.h"

#include <cmath>
#include <map>
#include <vector>

#include "experiments/runner/statistics/correlation.h"
#include "experiments/runner/statistics/means.h"
#include "experiments/runner/statistics/ranks.h"

namespace presa::statistics {
namespace {

using Groups = std::map<int, std::vector<std::size_t>>;

Groups groupsOf(std::span<const int> labels) {
  Groups groups;
  for (std::size_t i = 0; i < labels.size(); ++i) groups[labels[i]].push_back(i);
  return groups;
}

/// Ranks of one sample, stratum by stratum, minus the mean rank of the stratum. The product sum of two such samples has
/// expectation 0 under shuffling within strata.
struct StratifiedRanks {
  std::vector<double> ranks;

  StratifiedRanks(std::span<const double> values, const Groups& strata) {
    const std::vector<double> all = midRanks(values);
    for (const auto& [label, trials] : strata) {
      double sum = 0;
      for (const std::size_t trial : trials) sum += all[trial];
      for (const std::size_t trial : trials) ranks.push_back(all[trial] - sum / static_cast<double>(trials.size()));
    }
  }
};

double productSum(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace

std::optional<Interval> percentileInterval(std::span<const double> draws, double level) {
  const std::optional<double> low = quantile(draws, 0.5 - level / 2), high = quantile(draws, 0.5 + level / 2);
  if (!low || !(level > 0 && level < 1)) return std::nullopt;
  return Interval{*low, *high};
}

std::optional<PermutationTest> spearmanPermutation(std::span<const double> x, std::span<const double> y,
                                                   std::span<const int> strata, std::size_t shuffles,
                                                   RandomStream& random) {
  const std::optional<double> rho = spearman(x, y);
  if (!rho || strata.size() != x.size() || shuffles == 0) return std::nullopt;
  const Groups groups = groupsOf(strata);
  const StratifiedRanks of_x(x, groups);
  StratifiedRanks of_y(y, groups);
  const double n = static_cast<double>(x.size());
  const double rounding = 1e-12 * n * n * n;  // product sums are of order n^3; equal ones count as hits
  const double observed = std::abs(productSum(of_x.ranks, of_y.ranks)) - rounding;

  PermutationTest test{*rho, 1, 0, shuffles};
  for (std::size_t i = 0; i < shuffles; ++i) {
    std::span<double> rest(of_y.ranks);
    for (const auto& [label, trials] : groups) {
      random.shuffle(rest.first(trials.size()));
      rest = rest.subspan(trials.size());
    }
    test.hits += std::abs(productSum(of_x.ranks, of_y.ranks)) >= observed;
  }
  test.p = static_cast<double>(1 + test.hits) / static_cast<double>(1 + shuffles);
  return test;
}

SubjectBootstrap bootstrapSubjects(std::span<const int> subjects, const TrialStatistic& statistic, std::size_t draws,
                                   double level, RandomStream& random) {
  const Groups groups = groupsOf(subjects);
  SubjectBootstrap result{std::nullopt, "", groups.size(), draws, 0};
  if (groups.size() < kFewestSubjects) {
    result.why_not = "fewer than 8 subjects: no claim about a population";
    return result;
  }
  std::vector<const std::vector<std::size_t>*> trials_of;
  for (const auto& [label, trials] : groups) trials_of.push_back(&trials);
  std::vector<double> values;
  std::vector<std::size_t> drawn;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    drawn.clear();
    for (std::size_t i = 0; i < trials_of.size(); ++i) {
      const std::vector<std::size_t>& trials = *trials_of[random.below(trials_of.size())];
      drawn.insert(drawn.end(), trials.begin(), trials.end());
    }
    const std::optional<double> value = statistic(drawn);
    if (value && std::isfinite(*value)) values.push_back(*value);
  }
  result.undefined = draws - values.size();
  result.interval = percentileInterval(values, level);
  if (!result.interval) result.why_not = "no draw gave a value, or the level does not lie between 0 and 1";
  return result;
}

}  // namespace presa::statistics
