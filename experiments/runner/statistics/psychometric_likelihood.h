#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "experiments/runner/statistics/nelder_mead.h"
#include "experiments/runner/statistics/psychometric.h"

/// Implementation of psychometric.h: the likelihood in the coordinates of the search.
namespace presa::statistics::detail {

/// Location on the shape's axis, from the middle of the levels in units of their range; ln(spread) in the same unit; an
/// angle whose squared sine is lapse / largest lapse, so that the search can reach both bounds of the lapse.
using Coordinates = std::array<double, 3>;

class Likelihood {
 public:
  /// Levels sorted by distinct x, each with trials, at least two; the model is valid.
  Likelihood(std::vector<StimulusLevel> levels, const PsychometricModel& model);

  PsychometricFunction functionAt(const Coordinates& at) const;
  Coordinates coordinatesOf(const PsychometricFunction& function) const;
  double negativeLog(const PsychometricFunction& function) const;
  /// Negative log-likelihood of the saturated model, the lower bound of all models.
  double saturatedNegativeLog() const;
  /// The minimum near `start`.
  PsychometricFunction minimise(const Coordinates& start) const;
  bool fitsLapse() const { return !model_.lapse.has_value(); }
  std::span<const StimulusLevel> levels() const { return levels_; }
  /// Number of levels that lie on neither asymptote.
  int levelsOnSlope(const PsychometricFunction& function) const;
  /// Replaces the hits of all levels by random answers of `function`.
  void answer(const PsychometricFunction& function, RandomStream& random);

 private:
  std::vector<StimulusLevel> levels_;
  std::vector<double> axis_;  ///< of each level
  PsychometricModel model_;
  double middle_ = 0, range_ = 1;
};

/// Converts the levels to the input of Likelihood; otherwise the verdict says why there is nothing to fit.
FitVerdict prepared(std::span<const StimulusLevel> levels, const PsychometricModel& model,
                    std::vector<StimulusLevel>& distinct);
/// kAllHits, kNoHits or kFitted.
FitVerdict hitsAllow(std::span<const StimulusLevel> levels);

}  // namespace presa::statistics::detail
