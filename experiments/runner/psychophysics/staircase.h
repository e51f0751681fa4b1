#pragma once
#include <limits>
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/method.h"

namespace presa::psychophysics {

/// An n-down-1-up staircase on the distance d from the standard: d falls after `down` consecutive positive answers and
/// rises after each negative one. PsychoPy's names: startVal, stepSizes, nDown, minVal, maxVal, applyInitialRule.
/// PsychoPy applies a new step size already at the reversal; here it applies from the step after it.
struct StaircaseRule {
  double start = 0;
  std::vector<double> steps_up{};  ///< > 0; moves to the next size after every `change_after` reversals, keeps the last
  std::size_t change_after = 1;    ///< reversals
  std::size_t down = 1;            ///< n of n-down-1-up
  double down_up_ratio = 1;        ///< step down / step up
  bool one_down_first = false;     ///< 1-down-1-up until the first reversal
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::size_t stop_reversals = 0;  ///< 0: stops by `stop_trials` only
  std::size_t stop_trials = 0;     ///< > 0; required, since an observer who is always right makes no reversals
  int side = 1;                    ///< -1: levels are -d, below the standard; answers are coded as correct

  /// Proportion of positive answers at which steps up and down cancel: p^n = 1 / (1 + ratio). Ratio 1: Levitt's 70.71 %
  /// (n = 2), 79.37 % (n = 3). Only the ratios 0.5488 (n = 2, 80.35 %) and 0.7393 (n = 3, 83.15 %) converge to it at
  /// any step size [GarciaPerez1998].
  double targetProportion() const;
};

/// Weighted up/down [Kaernbach1991]: 1-up-1-down with unequal steps; `target` in (0, 1) is the proportion to converge
/// to.
StaircaseRule weightedUpDown(double target);

std::vector<std::string> mistakes(const StaircaseRule& rule);

class Staircase final : public Method {
 public:
  /// Throws std::invalid_argument naming every mistake of the rule.
  explicit Staircase(StaircaseRule rule);

  const StaircaseRule& rule() const noexcept { return rule_; }
  /// Distances d at which the direction changed: the level of the trial that caused the reversal.
  const std::vector<double>& reversals() const noexcept { return reversals_; }
  /// Mean of the last `last` reversals (choose an even number: as many peaks as valleys); nullopt with fewer. It
  /// estimates the distance at `targetProportion()` with a bias: 7-10 % too far for n = 2 and 1-3 % for n = 3 in a
  /// usual setting (see tests). A single run scatters by about a quarter of the threshold, and reversals are not
  /// independent, so there is no interval: pool the trials of several staircases and fit them (tally.h).
  std::optional<double> threshold(std::size_t last) const;

 private:
  void update(Trial& trial) override;
  std::optional<Stimulus> choose() override;
  void move(int direction);

  StaircaseRule rule_;
  double distance_;
  std::size_t answers_ = 0, run_ = 0;
  int direction_ = 0;
  std::vector<double> reversals_;
};

}  // namespace presa::psychophysics
