#pragma once
#include <limits>
#include <string>
#include <vector>

#include "framework/core/math/random.h"
#include "experiments/runner/psychophysics/method.h"

namespace presa::psychophysics {

struct AdjustmentPlan {
  double centre = 0;              ///< level about which the starts lie: where the answer is expected
  double nearest = 0;             ///< least distance of a start from it, >= 0
  double farthest = 0;            ///< greatest, > 0
  std::size_t trials = 0;         ///< > 0
  double coarse = 0, fine = 0;    ///< steps of the level, coarse >= fine > 0
  std::size_t confirmations = 1;  ///< presses in a row that end a trial, > 0
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

std::vector<std::string> mistakes(const AdjustmentPlan& plan);

/// What the participant has set.
struct Settings {
  std::size_t n = 0;
  double mean = 0;
  double sd = 0;  ///< of the settings, n - 1; 0 below two of them
  /// Means by start; their difference is the pull of the start. NaN without such a trial.
  double mean_from_below = std::numeric_limits<double>::quiet_NaN();
  double mean_from_above = std::numeric_limits<double>::quiet_NaN();
};

/// Method of adjustment: each trial starts at a level drawn above or below the centre (half of the trials each, one more
/// of a drawn side when odd) and is answered by the level where the participant stops. `track` is 0 below, 1 above. A
/// discarded start changes places with one of those left.
class Adjustment final : public Method {
 public:
  /// Throws std::invalid_argument naming every mistake of the plan.
  Adjustment(AdjustmentPlan plan, const RandomStream& stream);

  Settings settings() const;

 private:
  void update(Trial& trial) override;
  std::optional<Stimulus> choose() override;
  Stimulus again(const Stimulus& discarded) override;

  AdjustmentPlan plan_;
  RandomStream stream_;
  std::vector<double> starts_;
  std::size_t answered_ = 0;
};

enum class AdjustmentKey { kUp, kDown, kUpFine, kDownFine, kConfirm };

/// One trial of it: the level follows the keys until it is confirmed.
class Adjuster {
 public:
  Adjuster(const AdjustmentPlan& plan, double start);
  /// Nothing once `done()`.
  void press(AdjustmentKey key);
  double level() const noexcept { return level_; }
  /// Confirmed as often in a row as the plan asks for.
  bool done() const noexcept { return confirmed_ == plan_.confirmations; }

 private:
  AdjustmentPlan plan_;
  double level_;
  std::size_t confirmed_ = 0;
};

}  // namespace presa::psychophysics
