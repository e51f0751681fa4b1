#include "experiments/runner/statistics/correlation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "experiments/runner/statistics/distributions.h"
#include "experiments/runner/statistics/means.h"
#include "experiments/runner/statistics/ranks.h"

namespace presa::statistics {
namespace {

bool arePaired(std::span<const double> x, std::span<const double> y) {
  return x.size() == y.size() && x.size() >= 2 && allFinite(x) && allFinite(y);
}

bool isConstant(std::span<const double> x) {
  return std::all_of(x.begin(), x.end(), [&](double value) { return value == x.front(); });
}

/// Deviations from the mean, divided by the largest, so that their squares neither overflow nor underflow.
std::vector<double> deviations(std::span<const double> x) {
  std::vector<double> result(x.begin(), x.end());
  const double centre = *mean(x);
  double largest = 0;
  for (double& value : result) value -= centre, largest = std::max(largest, std::abs(value));
  for (double& value : result) value /= largest;
  return result;
}

int signOf(double difference) { return (difference > 0) - (difference < 0); }

}  // namespace

std::optional<double> pearson(std::span<const double> x, std::span<const double> y) {
  if (!arePaired(x, y) || isConstant(x) || isConstant(y)) return std::nullopt;
  const std::vector<double> dx = deviations(x), dy = deviations(y);
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) xx += dx[i] * dx[i], yy += dy[i] * dy[i], xy += dx[i] * dy[i];
  return std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);  // exactly +-1 for a perfect sample: sqrt of a square is exact
}

std::optional<double> spearman(std::span<const double> x, std::span<const double> y) {
  if (!arePaired(x, y)) return std::nullopt;
  return pearson(midRanks(x), midRanks(y));
}

std::optional<double> kendallTauB(std::span<const double> x, std::span<const double> y) {
  if (!arePaired(x, y) || isConstant(x) || isConstant(y)) return std::nullopt;
  std::int64_t score = 0, untied_x = 0, untied_y = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int sx = signOf(x[i] - x[j]), sy = signOf(y[i] - y[j]);
      score += std::int64_t{sx} * sy, untied_x += sx != 0, untied_y += sy != 0;
    }
  }
  return static_cast<double>(score) / std::sqrt(static_cast<double>(untied_x) * static_cast<double>(untied_y));
}

std::optional<Interval> bonettWright(double rho, std::size_t n, double level) {
  if (n < 4 || !(std::abs(rho) <= 1) || !(level > 0 && level < 1)) return std::nullopt;
  const double error = std::sqrt((1 + rho * rho / 2) / static_cast<double>(n - 3));
  const double reach = normalQuantile(0.5 + level / 2) * error;
  return Interval{std::tanh(std::atanh(rho) - reach), std::tanh(std::atanh(rho) + reach)};
}

std::optional<SpearmanTest> spearmanTest(double rho, std::size_t n, double level) {
  const std::optional<Interval> interval = bonettWright(rho, n, level);
  if (!interval) return std::nullopt;
  const double df = static_cast<double>(n - 2);
  const double t = rho * std::sqrt(df / (1 - rho * rho));
  return SpearmanTest{n, rho, t, studentTwoSidedP(t, df), *interval};
}

std::optional<SpearmanTest> spearmanTest(std::span<const double> x, std::span<const double> y, double level) {
  const std::optional<double> rho = spearman(x, y);
  return rho ? spearmanTest(*rho, x.size(), level) : std::nullopt;
}

std::optional<double> criticalCorrelation(std::size_t n, double alpha) {
  if (n < 3 || !(alpha > 0 && alpha < 1)) return std::nullopt;
  const double df = static_cast<double>(n - 2);
  const double t = studentQuantile(1 - alpha / 2, df);
  return t / std::sqrt(df + t * t);
}

}  // namespace presa::statistics
