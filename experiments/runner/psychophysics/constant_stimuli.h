#pragma once
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/method.h"
#include "framework/core/math/random.h"

namespace presa::psychophysics {

struct ConstantStimuliPlan {
  std::vector<double> levels{};  ///< all different
  std::size_t per_level = 0;     ///< trials of each level, > 0
  std::size_t per_block = 1;     ///< trials of each level in a block; divides `per_level`
};

std::vector<std::string> mistakes(const ConstantStimuliPlan& plan);

/// Method of constant stimuli: blocks with every level equally often, each block shuffled. `track` is the index of the
/// level, so that `ForcedChoice` balances the place of the standard within each level. A discarded trial moves to a
/// random place among the remaining ones of its block.
class ConstantStimuli final : public Method {
 public:
  /// Throws std::invalid_argument naming every mistake of the plan.
  ConstantStimuli(ConstantStimuliPlan plan, const RandomStream& stream);

 private:
  void update(Trial& trial) override;
  std::optional<Stimulus> choose() override;
  Stimulus again(const Stimulus& discarded) override;

  ConstantStimuliPlan plan_;
  RandomStream stream_;
  std::vector<std::size_t> order_;  ///< index of the level of each trial
  std::size_t answered_ = 0;
};

}  // namespace presa::psychophysics
