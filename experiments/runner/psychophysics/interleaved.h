#pragma once
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/staircase.h"
#include "framework/core/math/random.h"

namespace presa::psychophysics {

struct InterleavedPlan {
  std::vector<StaircaseRule> tracks{};
  double catch_rate = 0;   ///< probability that a trial is a catch trial, in [0, 1)
  double catch_level = 0;  ///< level of a catch trial
};

/// Staircases with the rule above and below the standard, `copies` of each.
std::vector<StaircaseRule> onBothSides(StaircaseRule rule, std::size_t copies);

std::vector<std::string> mistakes(const InterleavedPlan& plan);

/// Interleaved staircases: each trial is taken from a random unfinished one, so that participants cannot follow the
/// rule; catch trials in between. Finished when every staircase is.
class Interleaved final : public Method {
 public:
  /// Throws std::invalid_argument naming every mistake of the plan.
  Interleaved(const InterleavedPlan& plan, const RandomStream& stream);

  const std::vector<Staircase>& tracks() const noexcept { return tracks_; }
  /// Mean of the staircases' thresholds; nullopt while one of them has fewer than `last` reversals.
  std::optional<double> threshold(std::size_t last) const;

 private:
  void update(Trial& trial) override;
  std::optional<Stimulus> choose() override;

  double catch_rate_, catch_level_;
  std::vector<Staircase> tracks_;
  RandomStream stream_;
};

}  // namespace presa::psychophysics
