#pragma once
#include <cstddef>
#include <optional>
#include <span>

#include "experiments/runner/statistics/interval.h"

/// Association of two paired samples x[i], y[i], in any units. No result (nullopt) when the samples differ in length, hold
/// a value that is not finite, or one of them is constant: correlation is not defined there. Thread: any.
namespace presa::statistics {

/// Product-moment correlation; n >= 2.
std::optional<double> pearson(std::span<const double> x, std::span<const double> y);

/// Pearson's correlation of the mid-ranks, exact with ties (never the formula with squared rank differences); n >= 2.
std::optional<double> spearman(std::span<const double> x, std::span<const double> y);

/// (concordant - discordant) / sqrt((pairs not tied in x) (pairs not tied in y)); n >= 2. Work grows with n^2.
std::optional<double> kendallTauB(std::span<const double> x, std::span<const double> y);

/// tanh(atanh rho +- z sqrt((1 + rho^2 / 2) / (n - 3))) [Bonett & Wright 2000]; rho = +-1 gives that one point. No result
/// when n < 4, |rho| > 1 or the level does not lie between 0 and 1.
std::optional<Interval> bonettWright(double rho, std::size_t n, double level = 0.95);

/// Spearman's correlation with its inference. The cases must be independent: trials of one person are not (for those see
/// resampling.h).
struct SpearmanTest {
  std::size_t n = 0;
  double rho = 0;
  double t = 0;       ///< rho sqrt((n - 2) / (1 - rho^2)); infinite at rho = +-1
  double p = 1;       ///< two-sided, Student's t with n - 2 degrees of freedom
  Interval interval;  ///< Bonett & Wright, at the level asked for
};

/// n >= 4.
std::optional<SpearmanTest> spearmanTest(std::span<const double> x, std::span<const double> y, double level = 0.95);
/// The same of a correlation known by its value alone, as from a paper.
std::optional<SpearmanTest> spearmanTest(double rho, std::size_t n, double level = 0.95);

/// Smallest |r| that is significant on two sides at alpha: t / sqrt(n - 2 + t^2); n >= 3, 0 < alpha < 1.
std::optional<double> criticalCorrelation(std::size_t n, double alpha);

}  // namespace presa::statistics
