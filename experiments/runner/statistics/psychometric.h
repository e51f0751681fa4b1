#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "framework/core/math/random.h"
#include "experiments/runner/statistics/interval.h"
#include "experiments/runner/statistics/psychometric_function.h"

/// Maximum-likelihood fit of a psychometric function to counts per stimulus level. Deterministic. Thread: any.
namespace presa::statistics {

/// What was answered at one level. Entries of the same x, as of staircases, are added up; the order does not matter.
struct StimulusLevel {
  double x = 0;
  int trials = 0;
  int hits = 0;  ///< correct, or "the comparison is greater"
  bool operator==(const StimulusLevel&) const = default;
};

struct PsychometricModel {
  PsychometricShape shape = PsychometricShape::kNormal;
  std::optional<double> guess = 0.5;  ///< 1 / alternatives of a forced choice; none: equal to the lapse, as it is where
                                      ///< the answer is "the comparison is greater", P = lapse + (1 - 2 lapse) F
  std::optional<double> lapse{};      ///< none: fitted within [0, lapse_max]
  double lapse_max = 0.06;            ///< [Wichmann & Hill 2001]
};

enum class FitVerdict {
  kFitted,
  kBadInput,  ///< hits outside [0, trials], x not finite (Weibull: not > 0), no trial, asymptotes that leave no rise
  kOneLevel,  ///< all trials at one x
  kAllHits,
  kNoHits,
  kStep,  ///< fewer than two levels on the slope: any steeper function fits as well
  kFlat,  ///< no rise, or one too small to be placed: falling data end here, too
};
/// What a user is told, as "the answers do not rise with the stimulus".
const char* words(FitVerdict verdict);

struct PsychometricFit {
  PsychometricFunction function;
  double negative_log_likelihood = 0;  ///< of the single trials, without binomial coefficients
  double deviance = 0;                 ///< 2 (ln L of a free probability per level - ln L)
  std::size_t levels = 0, parameters = 0;
  /// P(deviance at least this large) by chi-square with levels - parameters degrees of freedom, none when there are none;
  /// rough below some 20 trials per level: see PsychometricBootstrap.
  std::optional<double> deviance_p;
};

struct PsychometricResult {
  FitVerdict verdict = FitVerdict::kBadInput;
  std::optional<PsychometricFit> fit;  ///< with kFitted, only then
};

/// Nelder-Mead from 12 starts. The likelihood is nearly flat in the lapse: do not interpret it.
PsychometricResult fitPsychometric(std::span<const StimulusLevel> levels, const PsychometricModel& model);

struct PsychometricBootstrap {
  Interval location, spread, jnd;
  std::vector<Interval> thresholds;  ///< of the proportions asked for
  double deviance_p = 1;             ///< share of simulated deviances that reach the observed, (1 + hits) / (1 + draws)
  std::size_t draws = 0;
  std::size_t undetermined =
      0;  ///< of these, left out of the intervals: all trials hits, none, or a Weibull too flat for doubles
};

/// Percentile intervals of a parametric bootstrap: the fitted function answers the same trials `draws` times, each is fitted
/// again from there. Of simulated observers with 140 to 240 trials, intervals at 95 % covered the threshold in 94 to 96 %,
/// spread and JND in 92 to 94 %. Every proportion must lie within the asymptotes at the largest lapse. No result when it
/// does not, for fewer than 20 draws, a fit of another model, a level outside (0, 1), or levels that do not give a fit.
std::optional<PsychometricBootstrap> bootstrapPsychometric(std::span<const StimulusLevel> levels,
                                                           const PsychometricModel& model, const PsychometricFit& fit,
                                                           std::span<const double> proportions, std::size_t draws,
                                                           double level, RandomStream& random);

}  // namespace presa::statistics
