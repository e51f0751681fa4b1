#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/tally.h"
#include "experiments/runner/statistics/interval.h"

namespace presa::psychophysics {

/// Grid values of one parameter. Each represents a cell that ends half-way to its neighbours.
struct Candidates {
  std::vector<double> values;   ///< ascending; a single value: the parameter is known
  std::vector<double> prior{};  ///< prior weight of each, any sum; empty: uniform
};

struct PosteriorGrid {
  Candidates threshold{}, spread{}, lapse{};  ///< location, spread and lapse of a statistics::PsychometricFunction
  std::optional<double> guess = 0.5;          ///< none: equal to the lapse rate, for "which was greater?"
  statistics::PsychometricShape shape = statistics::PsychometricShape::kNormal;
};

std::vector<std::string> mistakes(const PosteriorGrid& grid);

enum class Parameter { kThreshold, kSpread, kLapse };

/// Posterior over a psychometric function from binary trials on a grid. It holds for any method of choosing the levels,
/// because the likelihood does not depend on the choice. Probabilities are clamped to [1e-12, 1 - 1e-12], so an answer
/// that every candidate excludes does not make the posterior vanish.
class Posterior {
 public:
  /// Throws std::invalid_argument naming every mistake of the grid.
  explicit Posterior(PosteriorGrid grid);

  /// Number of cells: all combinations of candidates. The lapse index runs fastest, then the spread.
  std::size_t size() const noexcept { return weights_.size(); }
  /// Posterior weight of each cell; the sum is 1.
  std::span<const double> weights() const noexcept { return weights_; }
  /// P(positive) at `level` for one cell; a Weibull function equals its guess rate at level <= 0.
  double probability(std::size_t cell, double level) const;

  void update(double level, bool positive);
  /// Same, with `probability(cell, level)` of every cell precomputed.
  void update(std::span<const double> probabilities, bool positive);
  /// Same, for all answers at one level.
  void update(const statistics::StimulusLevel& count);

  double mean(Parameter parameter) const;
  double sd(Parameter parameter) const;
  /// Equal-tailed credible interval of probability `mass` in (0, 1). Its coverage is nominal for truths drawn from the
  /// prior, only approximate for a single fixed truth.
  statistics::Interval credible(Parameter parameter, double mass) const;
  /// Entropy of the joint posterior [nat].
  double entropy() const;
  /// Marginal weight of each candidate of one parameter.
  std::vector<double> marginal(Parameter parameter) const;

 private:
  const Candidates& candidates(Parameter parameter) const;
  void normalise();

  PosteriorGrid grid_;
  std::vector<double> weights_;
};

}  // namespace presa::psychophysics
