// Bayesian posterior on a grid of threshold x spread x lapse. Each answer multiplies the weights by its likelihood, and
// the weights are normalised to sum 1. Several answers at one level are added as logarithms, so that the product cannot
// underflow. Credible intervals take the density as uniform within a cell.
#include "experiments/runner/psychophysics/posterior.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace presa::psychophysics {
namespace {

double priorOf(const Candidates& candidates, std::size_t i) {
  return candidates.prior.empty() ? 1 : candidates.prior[i];
}

void findMistakes(const Candidates& candidates, const std::string& name, std::vector<std::string>& found) {
  const auto& [values, prior] = candidates;
  const auto is_weight = [](double weight) { return weight >= 0 && std::isfinite(weight); };
  if (values.empty() || !std::ranges::all_of(values, [](double value) { return std::isfinite(value); }) ||
      std::ranges::adjacent_find(values, std::greater_equal<>{}) != values.end()) {
    found.push_back("the candidates of the " + name + " must be finite and rise");
  }
  if (!prior.empty() && (prior.size() != values.size() || !std::ranges::all_of(prior, is_weight) ||
                         !(std::accumulate(prior.begin(), prior.end(), 0.0) > 0))) {
    found.push_back("the prior of the " + name + " must have a weight >= 0 for each candidate and one above 0");
  }
}

/// Lower edge of the cell of the i-th candidate; i = size: upper edge of the last. Precondition: more than one
/// candidate.
double cellEdge(const std::vector<double>& values, std::size_t i) {
  if (i == 0) return values[0] - (values[1] - values[0]) / 2;
  const std::size_t n = values.size();
  if (i == n) return values[n - 1] + (values[n - 1] - values[n - 2]) / 2;
  return (values[i - 1] + values[i]) / 2;
}

double quantile(const std::vector<double>& values, const std::vector<double>& weights, double probability) {
  if (values.size() == 1) return values[0];
  double below = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (below + weights[i] >= probability && weights[i] > 0) {
      const double low = cellEdge(values, i);
      return low + (cellEdge(values, i + 1) - low) * (probability - below) / weights[i];
    }
    below += weights[i];
  }
  return cellEdge(values, values.size());
}

}  // namespace

std::vector<std::string> mistakes(const PosteriorGrid& grid) {
  std::vector<std::string> found;
  findMistakes(grid.threshold, "threshold", found);
  findMistakes(grid.spread, "spread", found);
  findMistakes(grid.lapse, "lapse rate", found);
  const auto require = [&](const Candidates& candidates, auto holds, const char* text) {
    if (!std::ranges::all_of(candidates.values, holds)) found.emplace_back(text);
  };
  require(
      grid.spread, [](double spread) { return spread > 0; }, "the spread must be > 0");
  require(
      grid.lapse,
      [&](double lapse) {
        const double guess = grid.guess.value_or(lapse);
        return lapse >= 0 && guess >= 0 && guess + lapse < 1;
      },
      "guess and lapse rate must be >= 0 and together < 1");
  if (grid.shape == statistics::PsychometricShape::kWeibull) {
    require(
        grid.threshold, [](double threshold) { return threshold > 0; },
        "the threshold of a Weibull function must be > 0");
  }
  return found;
}

Posterior::Posterior(PosteriorGrid grid) : grid_(std::move(grid)) {
  requireNone(mistakes(grid_));
  for (std::size_t t = 0; t < grid_.threshold.values.size(); ++t) {
    for (std::size_t s = 0; s < grid_.spread.values.size(); ++s) {
      for (std::size_t l = 0; l < grid_.lapse.values.size(); ++l) {
        weights_.push_back(priorOf(grid_.threshold, t) * priorOf(grid_.spread, s) * priorOf(grid_.lapse, l));
      }
    }
  }
  normalise();
}

double Posterior::probability(std::size_t cell, double level) const {
  const std::size_t lapses = grid_.lapse.values.size(), spreads = grid_.spread.values.size();
  const double lapse = grid_.lapse.values[cell % lapses];
  const statistics::PsychometricFunction function{.shape = grid_.shape,
                                                  .location = grid_.threshold.values[cell / lapses / spreads],
                                                  .spread = grid_.spread.values[cell / lapses % spreads],
                                                  .guess = grid_.guess.value_or(lapse),
                                                  .lapse = lapse};
  const bool from_zero = grid_.shape == statistics::PsychometricShape::kWeibull;
  return std::clamp(function.probability(from_zero ? std::max(level, 0.0) : level), 1e-12, 1 - 1e-12);
}

void Posterior::update(double level, bool positive) {
  for (std::size_t cell = 0; cell < size(); ++cell) {
    const double p = probability(cell, level);
    weights_[cell] *= positive ? p : 1 - p;
  }
  normalise();
}

void Posterior::update(std::span<const double> probabilities, bool positive) {
  for (std::size_t cell = 0; cell < size(); ++cell) {
    weights_[cell] *= positive ? probabilities[cell] : 1 - probabilities[cell];
  }
  normalise();
}

void Posterior::update(const statistics::StimulusLevel& count) {
  const double hits = count.hits, misses = count.trials - count.hits;
  std::vector<double> log_weights(size());
  for (std::size_t cell = 0; cell < size(); ++cell) {
    const double p = probability(cell, count.x);
    log_weights[cell] = std::log(weights_[cell]) + hits * std::log(p) + misses * std::log1p(-p);
  }
  const double greatest = *std::ranges::max_element(log_weights);
  for (std::size_t cell = 0; cell < size(); ++cell) weights_[cell] = std::exp(log_weights[cell] - greatest);
  normalise();
}

void Posterior::normalise() {
  const double sum = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  for (double& weight : weights_) weight /= sum;
}

const Candidates& Posterior::candidates(Parameter parameter) const {
  switch (parameter) {
    case Parameter::kThreshold:
      return grid_.threshold;
    case Parameter::kSpread:
      return grid_.spread;
    case Parameter::kLapse:
      break;
  }
  return grid_.lapse;
}

std::vector<double> Posterior::marginal(Parameter parameter) const {
  const std::size_t lapses = grid_.lapse.values.size(), spreads = grid_.spread.values.size();
  std::vector<double> sums(candidates(parameter).values.size());
  for (std::size_t cell = 0; cell < size(); ++cell) {
    const std::size_t at = parameter == Parameter::kThreshold ? cell / lapses / spreads
                           : parameter == Parameter::kSpread  ? cell / lapses % spreads
                                                              : cell % lapses;
    sums[at] += weights_[cell];
  }
  return sums;
}

double Posterior::mean(Parameter parameter) const {
  const std::vector<double> weights = marginal(parameter);
  return std::inner_product(weights.begin(), weights.end(), candidates(parameter).values.begin(), 0.0);
}

double Posterior::sd(Parameter parameter) const {
  const std::vector<double> weights = marginal(parameter);
  const std::vector<double>& values = candidates(parameter).values;
  const double middle = mean(parameter);
  double variance = 0;
  for (std::size_t i = 0; i < values.size(); ++i) variance += weights[i] * std::pow(values[i] - middle, 2);
  return std::sqrt(variance);
}

statistics::Interval Posterior::credible(Parameter parameter, double mass) const {
  const std::vector<double> weights = marginal(parameter);
  const std::vector<double>& values = candidates(parameter).values;
  return {quantile(values, weights, (1 - mass) / 2), quantile(values, weights, (1 + mass) / 2)};
}

double Posterior::entropy() const {
  double sum = 0;
  for (const double weight : weights_) sum -= weight > 0 ? weight * std::log(weight) : 0;
  return sum;
}

}  // namespace presa::psychophysics
