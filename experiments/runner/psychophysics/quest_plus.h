#pragma once
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/posterior.h"

namespace presa::psychophysics {

struct QuestPlusPlan {
  PosteriorGrid grid{};
  std::vector<double> levels{};  ///< stimuli to choose from
  std::size_t stop_trials = 0;   ///< > 0
  double stop_sd = 0;            ///< stops early when the posterior sd of the threshold is <= this; 0: never
};

std::vector<std::string> mistakes(const QuestPlusPlan& plan);

/// QUEST+ [Watson2017]: presents the level that minimises the expected entropy of the posterior over threshold, spread
/// and lapse rate; ties go to the first level of the list. With a single candidate for spread and lapse rate it reduces
/// to QUEST [WatsonPelli1983] with the entropy rule; choose QUEST's Weibull shape and Gaussian prior in `grid`. Draws
/// no random numbers. Stores two tables of levels x cells: 40 x 840 take 0.5 MB, 2 ms to build and 0.03 ms per trial.
class QuestPlus final : public Method {
 public:
  /// Throws std::invalid_argument naming every mistake of the plan.
  explicit QuestPlus(QuestPlusPlan plan);

  const Posterior& posterior() const noexcept { return posterior_; }
  /// Expected entropy after the next answer, for each level of the plan [nat].
  std::vector<double> expectedEntropy() const;

 private:
  void update(Trial& trial) override;
  std::optional<Stimulus> choose() override;
  std::vector<double> expectedInformation() const;

  QuestPlusPlan plan_;
  Posterior posterior_;
  std::vector<double> probability_;     ///< P(positive), one row of cells per level
  std::vector<double> answer_entropy_;  ///< entropy of that answer, same layout
  std::size_t answers_ = 0, chosen_ = 0;
};

}  // namespace presa::psychophysics
