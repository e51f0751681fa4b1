// Binomial log-likelihood of P(x) = guess + (1 - guess - lapse) F(x), minimised by Nelder-Mead in the scaled
// coordinates of Coordinates, which make the fit independent of the unit of x. F and 1 - F are computed separately, so
// that neither tail loses precision. The lapse coordinate is an angle, which keeps the lapse within [0, lapse_max]
// without a constraint.
#include "experiments/runner/statistics/psychometric_likelihood.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace presa::statistics::detail {
namespace {

// bounds on the search: beyond them the function is a step or flat, and the search would diverge
constexpr double kFarthest = 100, kSteepest = 1e-5, kFlattest = 100;

double logTerm(int count, double probability) { return count == 0 ? 0 : count * std::log(probability); }

bool isValid(const PsychometricModel& model) {
  const double lapse = model.lapse.value_or(model.lapse_max), guess = model.guess.value_or(lapse);
  return lapse >= 0 && guess >= 0 && lapse + guess < 1;
}

}  // namespace

Likelihood::Likelihood(std::vector<StimulusLevel> levels, const PsychometricModel& model)
    : levels_(std::move(levels)), model_(model) {
  for (const StimulusLevel& level : levels_) axis_.push_back(axisOf(model_.shape, level.x));
  middle_ = 0.5 * (axis_.front() + axis_.back()), range_ = axis_.back() - axis_.front();
}

PsychometricFunction Likelihood::functionAt(const Coordinates& at) const {
  PsychometricFunction function{model_.shape};
  function.location = fromAxis(model_.shape, middle_ + range_ * std::clamp(at[0], -kFarthest, kFarthest));
  function.spread = range_ * std::clamp(std::exp(at[1]), kSteepest, kFlattest);
  function.lapse = model_.lapse.value_or(model_.lapse_max * std::pow(std::sin(at[2]), 2));
  function.guess = model_.guess.value_or(function.lapse);
  return function;
}

Coordinates Likelihood::coordinatesOf(const PsychometricFunction& function) const {
  const double share = fitsLapse() && model_.lapse_max > 0 ? function.lapse / model_.lapse_max : 0;
  return {(axisOf(model_.shape, function.location) - middle_) / range_, std::log(function.spread / range_),
          std::asin(std::sqrt(std::clamp(share, 0.0, 1.0)))};
}

double Likelihood::negativeLog(const PsychometricFunction& function) const {
  const double location = axisOf(function.shape, function.location), rise = 1 - function.guess - function.lapse;
  double sum = 0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const Rise at = riseAt(function.shape, (axis_[i] - location) / function.spread);
    sum -= logTerm(levels_[i].hits, function.guess + rise * at.reached) +
           logTerm(levels_[i].trials - levels_[i].hits, function.lapse + rise * at.left);
  }
  return sum;
}

double Likelihood::saturatedNegativeLog() const {
  double sum = 0;
  for (const StimulusLevel& level : levels_) {
    const double share = static_cast<double>(level.hits) / level.trials;
    sum -= logTerm(level.hits, share) + logTerm(level.trials - level.hits, 1 - share);
  }
  return sum;
}

PsychometricFunction Likelihood::minimise(const Coordinates& start) const {
  if (fitsLapse()) {
    return functionAt(nelderMead([this](const Coordinates& at) { return negativeLog(functionAt(at)); }, start).at);
  }
  const auto with_lapse = [&](const std::array<double, 2>& at) { return functionAt({at[0], at[1], start[2]}); };
  const std::array<double, 2> start_of_two{start[0], start[1]};
  return with_lapse(nelderMead([&](const auto& at) { return negativeLog(with_lapse(at)); }, start_of_two).at);
}

int Likelihood::levelsOnSlope(const PsychometricFunction& function) const {
  constexpr double kOnAsymptote = 1e-6;
  const double location = axisOf(function.shape, function.location);
  return static_cast<int>(std::count_if(axis_.begin(), axis_.end(), [&](double x) {
    const Rise at = riseAt(function.shape, (x - location) / function.spread);
    return std::min(at.reached, at.left) > kOnAsymptote;
  }));
}

void Likelihood::answer(const PsychometricFunction& function, RandomStream& random) {
  for (StimulusLevel& level : levels_) {
    const double p = function.probability(level.x);
    level.hits = 0;
    for (int trial = 0; trial < level.trials; ++trial) level.hits += random.uniform() < p;
  }
}

FitVerdict prepared(std::span<const StimulusLevel> levels, const PsychometricModel& model,
                    std::vector<StimulusLevel>& distinct) {
  if (!isValid(model)) return FitVerdict::kBadInput;
  std::map<double, StimulusLevel> by_x;
  for (const StimulusLevel& level : levels) {
    const bool has_place = std::isfinite(level.x) && (model.shape != PsychometricShape::kWeibull || level.x > 0);
    if (!has_place || level.hits < 0 || level.hits > level.trials) return FitVerdict::kBadInput;
    if (level.trials == 0) continue;
    StimulusLevel& sum = by_x[level.x];
    sum.x = level.x, sum.trials += level.trials, sum.hits += level.hits;
  }
  if (by_x.empty()) return FitVerdict::kBadInput;
  if (by_x.size() == 1) return FitVerdict::kOneLevel;
  if (!std::isfinite(by_x.rbegin()->first - by_x.begin()->first)) return FitVerdict::kBadInput;
  for (const auto& [x, level] : by_x) distinct.push_back(level);
  return hitsAllow(distinct);
}

FitVerdict hitsAllow(std::span<const StimulusLevel> levels) {
  const bool all =
      std::all_of(levels.begin(), levels.end(), [](const auto& level) { return level.hits == level.trials; });
  const bool none = std::all_of(levels.begin(), levels.end(), [](const auto& level) { return level.hits == 0; });
  return all ? FitVerdict::kAllHits : none ? FitVerdict::kNoHits : FitVerdict::kFitted;
}

}  // namespace presa::statistics::detail
