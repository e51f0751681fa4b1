#pragma once
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/posterior.h"

namespace presa::psychophysics {

struct QuestPlusPlan {
  PosteriorGrid grid{};
  std::vector<double> levels{};  ///< stimuli to choose from
  std::size_t stop_trials = 0;   ///< > 0
  double stop_sd = 0;            ///< stops earlier, once the posterior sd of the threshold is no greater; 0: never
};

std::vector<std::string> mistakes(const QuestPlusPlan& plan);

/// QUEST+ [Watson2017]: presents the level after whose answer the expected entropy of the posterior over threshold,
/// spread and lapse rate is least; the first of the list among equals. With one candidate for spread and for lapse rate
/// only the threshold is free: that is QUEST [WatsonPelli1983] with the entropy rule; its Weibull shape is a choice of
/// the grid, its Gaussian prior goes into `grid.threshold.prior`. Draws no random numbers. Keeps two tables of levels x
/// candidates: 40 x 840 take 0.5 MB, 2 ms to build and 0.03 ms per trial.
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
  std::vector<double> probability_;     ///< P(positive): a row of cells for each level
  std::vector<double> answer_entropy_;  ///< entropy of that answer, likewise
  std::size_t answers_ = 0, chosen_ = 0;
};

}  // namespace presa::psychophysics
