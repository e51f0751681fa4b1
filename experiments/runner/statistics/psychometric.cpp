// Maximum-likelihood fit [Wichmann & Hill 2001]: Nelder-Mead from 12 starts (4 locations x 3 spreads), of which the
// best end point is kept. Data that do not determine a function give a FitVerdict instead of a fit: no rise, or fewer
// than two levels on the slope. The bootstrap is parametric; it starts the fit of every draw at the fitted function.
#include "experiments/runner/statistics/psychometric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/runner/statistics/distributions.h"
#include "experiments/runner/statistics/psychometric_likelihood.h"
#include "experiments/runner/statistics/resampling.h"

namespace presa::statistics {
namespace {

using detail::Likelihood;

PsychometricFunction bestOfAllStarts(const Likelihood& likelihood) {
  constexpr double kQuarterOfLargestLapse = std::numbers::pi / 6;  // the lapse is lapse_max sin^2 of it
  PsychometricFunction best;
  double min = std::numeric_limits<double>::infinity();
  for (const double location : {-0.3, -0.1, 0.1, 0.3}) {
    for (const double spread : {0.05, 0.2, 0.8}) {
      const PsychometricFunction found = likelihood.minimise({location, std::log(spread), kQuarterOfLargestLapse});
      if (const double value = likelihood.negativeLog(found); value < min) min = value, best = found;
    }
  }
  return best;
}

FitVerdict verdictOn(const Likelihood& likelihood, const PsychometricFunction& function) {
  constexpr double kTooFar = 10;  // in units of the range of the levels
  const detail::Coordinates at = likelihood.coordinatesOf(function);
  if (std::abs(at[0]) > kTooFar || std::exp(at[1]) > kTooFar) return FitVerdict::kFlat;
  return likelihood.levelsOnSlope(function) < 2 ? FitVerdict::kStep : FitVerdict::kFitted;
}

double devianceOf(const Likelihood& likelihood, const PsychometricFunction& function) {
  return std::max(0.0, 2 * (likelihood.negativeLog(function) - likelihood.saturatedNegativeLog()));
}

/// True when the function belongs to the model and has these thresholds for every allowed lapse.
bool hasThresholds(const PsychometricModel& model, const PsychometricFunction& function,
                   std::span<const double> proportions) {
  const double lapse = model.lapse.value_or(model.lapse_max), guess = model.guess.value_or(lapse);
  const bool is_of_model = function.shape == model.shape && function.guess <= guess && function.lapse <= lapse &&
                           function.spread > 0 && std::isfinite(function.location) && std::isfinite(function.jnd());
  const auto is_inside = [&](double p) { return guess < p && p < 1 - lapse; };
  return is_of_model && std::all_of(proportions.begin(), proportions.end(), is_inside);
}

}  // namespace

const char* words(FitVerdict verdict) {
  switch (verdict) {
    case FitVerdict::kFitted:
      return "fitted";
    case FitVerdict::kBadInput:
      return "the levels or the model are not valid";
    case FitVerdict::kOneLevel:
      return "all trials are at one level";
    case FitVerdict::kAllHits:
      return "every trial was a hit";
    case FitVerdict::kNoHits:
      return "no trial was a hit";
    case FitVerdict::kStep:
      return "fewer than two levels lie on the slope, so its steepness has no upper bound";
    case FitVerdict::kFlat:
      return "the answers do not rise with the stimulus";
  }
  return "";
}

PsychometricResult fitPsychometric(std::span<const StimulusLevel> levels, const PsychometricModel& model) {
  std::vector<StimulusLevel> distinct;
  if (const FitVerdict verdict = detail::prepared(levels, model, distinct); verdict != FitVerdict::kFitted) {
    return {verdict, {}};
  }
  const Likelihood likelihood(std::move(distinct), model);
  PsychometricFit fit;
  fit.function = bestOfAllStarts(likelihood);
  if (const FitVerdict verdict = verdictOn(likelihood, fit.function); verdict != FitVerdict::kFitted) {
    return {verdict, {}};
  }
  fit.negative_log_likelihood = likelihood.negativeLog(fit.function);
  fit.deviance = devianceOf(likelihood, fit.function);
  fit.levels = likelihood.levels().size(), fit.parameters = likelihood.fitsLapse() ? 3 : 2;
  if (fit.levels > fit.parameters) {
    fit.deviance_p = chiSquareUpperP(fit.deviance, static_cast<double>(fit.levels - fit.parameters));
  }
  return {FitVerdict::kFitted, fit};
}

std::optional<PsychometricBootstrap> bootstrapPsychometric(std::span<const StimulusLevel> levels,
                                                           const PsychometricModel& model, const PsychometricFit& fit,
                                                           std::span<const double> proportions, std::size_t draws,
                                                           double level, RandomStream& random) {
  std::vector<StimulusLevel> distinct;
  const bool is_fit = detail::prepared(levels, model, distinct) == FitVerdict::kFitted;
  if (!is_fit || draws < 20 || !(level > 0 && level < 1) || !hasThresholds(model, fit.function, proportions)) return {};

  Likelihood simulated(std::move(distinct), model);
  const detail::Coordinates start = simulated.coordinatesOf(fit.function);
  std::vector<double> locations, spreads, jnds;
  std::vector<std::vector<double>> thresholds(proportions.size());
  std::size_t as_deviant = 0;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    simulated.answer(fit.function, random);
    if (detail::hitsAllow(simulated.levels()) != FitVerdict::kFitted) continue;
    const PsychometricFunction again = simulated.minimise(start);
    if (!std::isfinite(again.location) || !std::isfinite(again.jnd())) continue;  // a Weibull too flat
    as_deviant += devianceOf(simulated, again) >= fit.deviance;
    locations.push_back(again.location), spreads.push_back(again.spread), jnds.push_back(again.jnd());
    for (std::size_t i = 0; i < proportions.size(); ++i) thresholds[i].push_back(*again.threshold(proportions[i]));
  }
  if (locations.empty()) return std::nullopt;
  PsychometricBootstrap result;
  result.location = *percentileInterval(locations, level);
  result.spread = *percentileInterval(spreads, level);
  result.jnd = *percentileInterval(jnds, level);
  for (const std::vector<double>& values : thresholds) result.thresholds.push_back(*percentileInterval(values, level));
  result.draws = draws, result.undetermined = draws - locations.size();
  result.deviance_p = static_cast<double>(1 + as_deviant) / static_cast<double>(1 + locations.size());
  return result;
}

}  // namespace presa::statistics
