#pragma once
#include <string>
#include <vector>

#include "framework/core/math/random.h"
#include "experiments/runner/psychophysics/staircase.h"

namespace presa::psychophysics {

struct InterleavedPlan {
  std::vector<StaircaseRule> tracks{};
  double catch_rate = 0;   ///< probability that a trial is a catch trial, in [0, 1)
  double catch_level = 0;  ///< what a catch trial presents
};

/// The rule above and below the standard, each `copies` times.
std::vector<StaircaseRule> onBothSides(StaircaseRule rule, std::size_t copies);

std::vector<std::string> mistakes(const InterleavedPlan& plan);

/// Several staircases side by side, each trial from a random one that still runs, so that no participant can follow
/// the rule; catch trials between them. Finished when every staircase is.
class Interleaved final : public Method {
 public:
  /// Throws std::invalid_argument naming every mistake of the plan.
  Interleaved(const InterleavedPlan& plan, const RandomStream& stream);

  const std::vector<Staircase>& tracks() const noexcept { return tracks_; }
  /// Mean of the staircases' thresholds; none while one of them has fewer than `last` reversals.
  std::optional<double> threshold(std::size_t last) const;

 private:
  void update(Trial& trial) override;
  std::optional<Stimulus> choose() override;

  double catch_rate_, catch_level_;
  std::vector<Staircase> tracks_;
  RandomStream stream_;
};

}  // namespace presa::psychophysics
