#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "experiments/runner/statistics/nelder_mead.h"
#include "experiments/runner/statistics/psychometric.h"

/// Behind psychometric.h: the likelihood in the coordinates in which it is searched.
namespace presa::statistics::detail {

/// Location on the shape's axis in units of the range of the levels, from their middle; ln of the spread in these units; an
/// angle whose squared sine is the share of the largest lapse, so that both its bounds can be reached.
using Coordinates = std::array<double, 3>;

class Likelihood {
 public:
  /// Levels sorted, with distinct x and trials, at least two; the model valid.
  Likelihood(std::vector<StimulusLevel> levels, const PsychometricModel& model);

  PsychometricFunction functionAt(const Coordinates& at) const;
  Coordinates coordinatesOf(const PsychometricFunction& function) const;
  double negativeLog(const PsychometricFunction& function) const;
  /// The least that any probabilities of the levels give.
  double saturatedNegativeLog() const;
  /// The minimum near `start`.
  PsychometricFunction minimise(const Coordinates& start) const;
  bool fitsLapse() const { return !model_.lapse.has_value(); }
  std::span<const StimulusLevel> levels() const { return levels_; }
  /// How many levels lie neither on the lower nor on the upper asymptote.
  int levelsOnSlope(const PsychometricFunction& function) const;
  /// Draws the hits of all levels anew.
  void answer(const PsychometricFunction& function, RandomStream& random);

 private:
  std::vector<StimulusLevel> levels_;
  std::vector<double> axis_;  ///< of each level
  PsychometricModel model_;
  double middle_ = 0, range_ = 1;
};

/// The levels as Likelihood wants them, or why there is nothing to fit.
FitVerdict prepared(std::span<const StimulusLevel> levels, const PsychometricModel& model,
                    std::vector<StimulusLevel>& distinct);
/// kAllHits, kNoHits or kFitted.
FitVerdict hitsAllow(std::span<const StimulusLevel> levels);

}  // namespace presa::statistics::detail
