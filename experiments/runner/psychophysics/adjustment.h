#pragma once
#include <limits>
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/method.h"
#include "framework/core/math/random.h"

namespace presa::psychophysics {

struct AdjustmentPlan {
  double centre = 0;              ///< level around which the starts lie: the expected answer
  double nearest = 0;             ///< min distance of a start from the centre, >= 0
  double farthest = 0;            ///< max distance of a start from the centre, > 0
  std::size_t trials = 0;         ///< > 0
  double coarse = 0, fine = 0;    ///< steps of the level, coarse >= fine > 0
  std::size_t confirmations = 1;  ///< consecutive presses of the confirm key that end a trial, > 0
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

std::vector<std::string> mistakes(const AdjustmentPlan& plan);

/// Summary of the levels set by the participant.
struct Settings {
  std::size_t n = 0;
  double mean = 0;
  double sd = 0;  ///< of the settings (n - 1); 0 with fewer than two
  /// Mean setting per side of the start; their difference shows the bias towards the start. NaN without such a trial.
  double mean_from_below = std::numeric_limits<double>::quiet_NaN();
  double mean_from_above = std::numeric_limits<double>::quiet_NaN();
};

/// Method of adjustment. Each trial starts at a random level below (`track` 0) or above (`track` 1) the centre, half of
/// the trials each, with the odd one on a random side; the answer is the level at which the participant stops. A
/// discarded start is exchanged for a random one of those left.
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

/// Key handling of one adjustment trial: the level follows the keys until it is confirmed.
class Adjuster {
 public:
  Adjuster(const AdjustmentPlan& plan, double start);
  /// No effect once `done()`.
  void press(AdjustmentKey key);
  double level() const noexcept { return level_; }
  /// True after the required number of consecutive confirmations.
  bool done() const noexcept { return confirmed_ == plan_.confirmations; }

 private:
  AdjustmentPlan plan_;
  double level_;
  std::size_t confirmed_ = 0;
};

}  // namespace presa::psychophysics
