#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/tally.h"
#include "experiments/runner/statistics/interval.h"

namespace presa::psychophysics {

/// The values a parameter may have. Each stands for the cell around it, which ends half-way to its neighbours.
struct Candidates {
  std::vector<double> values;   ///< rising; one value: the parameter is known
  std::vector<double> prior{};  ///< weight of each, any sum; empty: all alike
};

struct PosteriorGrid {
  Candidates threshold{}, spread{}, lapse{};  ///< location, spread and lapse of a statistics::PsychometricFunction
  std::optional<double> guess = 0.5;          ///< none: as the lapse rate, for "which was greater?"
  statistics::PsychometricShape shape = statistics::PsychometricShape::kNormal;
};

std::vector<std::string> mistakes(const PosteriorGrid& grid);

enum class Parameter { kThreshold, kSpread, kLapse };

/// What binary trials say about the psychometric function, whichever method chose their levels: the likelihood does not
/// depend on the choice. Probabilities are kept 1e-12 off 0 and 1: a slip that a candidate calls impossible leaves it a
/// trace, and the posterior is never empty.
class Posterior {
 public:
  /// Throws std::invalid_argument naming every mistake of the grid.
  explicit Posterior(PosteriorGrid grid);

  /// All combinations of candidates; the lapse runs fastest, then the spread.
  std::size_t size() const noexcept { return weights_.size(); }
  /// Sum 1.
  std::span<const double> weights() const noexcept { return weights_; }
  /// P(positive) at the level under one combination; a Weibull function has not risen at level 0 and below.
  double probability(std::size_t cell, double level) const;

  void update(double level, bool positive);
  /// The same with `probability` of every cell at hand.
  void update(std::span<const double> probabilities, bool positive);
  /// All answers at one level.
  void update(const statistics::StimulusLevel& count);

  double mean(Parameter parameter) const;
  double sd(Parameter parameter) const;
  /// Holds the parameter with probability `mass` in (0, 1), as much of the rest on either side. It covers at that rate
  /// when truths follow the prior; at a given truth only about so.
  statistics::Interval credible(Parameter parameter, double mass) const;
  /// Of all parameters together [nat].
  double entropy() const;
  /// Weight of each candidate of one parameter.
  std::vector<double> marginal(Parameter parameter) const;

 private:
  const Candidates& candidates(Parameter parameter) const;
  void normalise();

  PosteriorGrid grid_;
  std::vector<double> weights_;
};

}  // namespace presa::psychophysics
