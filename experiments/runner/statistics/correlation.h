#pragma once
#include <cstddef>
#include <optional>
#include <span>

#include "experiments/runner/statistics/interval.h"

/// Correlation of two paired samples x[i], y[i], in any units. Nullopt when the samples differ in length, contain a
/// value that is not finite, or one of them is constant. Thread: any.
namespace presa::statistics {

/// Product-moment correlation; n >= 2.
std::optional<double> pearson(std::span<const double> x, std::span<const double> y);

/// Pearson's correlation of the mid-ranks, exact with ties (never the formula with squared rank differences); n >= 2.
std::optional<double> spearman(std::span<const double> x, std::span<const double> y);

/// (concordant - discordant) / sqrt((pairs not tied in x) (pairs not tied in y)); n >= 2. Work grows with n^2.
std::optional<double> kendallTauB(std::span<const double> x, std::span<const double> y);

/// tanh(atanh rho +- z sqrt((1 + rho^2 / 2) / (n - 3))) [Bonett & Wright 2000]; rho = +-1 gives a single point. Nullopt
/// when n < 4, |rho| > 1 or the level is not in (0, 1).
std::optional<Interval> bonettWright(double rho, std::size_t n, double level = 0.95);

/// Spearman's correlation with its inference. The cases must be independent; trials of one person are not (use
/// resampling.h for those).
struct SpearmanTest {
  std::size_t n = 0;
  double rho = 0;
  double t = 0;       ///< rho sqrt((n - 2) / (1 - rho^2)); infinite at rho = +-1
  double p = 1;       ///< two-sided, Student's t with n - 2 degrees of freedom
  Interval interval;  ///< Bonett & Wright, at the requested level
};

/// n >= 4.
std::optional<SpearmanTest> spearmanTest(std::span<const double> x, std::span<const double> y, double level = 0.95);
/// Same, from a known correlation, for example a published one.
std::optional<SpearmanTest> spearmanTest(double rho, std::size_t n, double level = 0.95);

/// Smallest |r| that is significant at alpha, two-sided: t / sqrt(n - 2 + t^2); n >= 3, 0 < alpha < 1.
std::optional<double> criticalCorrelation(std::size_t n, double alpha);

}  // namespace presa::statistics
