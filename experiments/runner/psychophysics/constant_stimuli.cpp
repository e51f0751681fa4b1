#include "experiments/runner/psychophysics/constant_stimuli.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace presa::psychophysics {

std::vector<std::string> mistakes(const ConstantStimuliPlan& plan) {
  std::vector<std::string> found;
  const auto require = [&](bool holds, const char* text) {
    if (!holds) found.emplace_back(text);
  };
  require(!plan.levels.empty(), "there must be at least one level");
  require(std::ranges::all_of(plan.levels, [](double level) { return std::isfinite(level); }), "levels must be finite");
  require(std::set<double>(plan.levels.begin(), plan.levels.end()).size() == plan.levels.size(),
          "a level must not come twice");
  require(plan.per_level > 0, "the number of trials per level must be > 0");
  require(plan.per_block > 0 && plan.per_level % plan.per_block == 0,
          "the trials per level must be a multiple of the trials per level and block");
  return found;
}

ConstantStimuli::ConstantStimuli(ConstantStimuliPlan plan, const RandomStream& stream)
    : plan_(std::move(plan)), stream_(stream) {
  requireNone(mistakes(plan_));
  std::vector<std::size_t> block;
  for (std::size_t i = 0; i < plan_.levels.size(); ++i) block.insert(block.end(), plan_.per_block, i);
  for (std::size_t done = 0; done < plan_.per_level; done += plan_.per_block) {
    stream_.shuffle(std::span<std::size_t>(block));
    order_.insert(order_.end(), block.begin(), block.end());
  }
  start();
}

void ConstantStimuli::update(Trial& /*trial*/) { ++answered_; }

std::optional<Stimulus> ConstantStimuli::choose() {
  if (answered_ == order_.size()) return std::nullopt;
  return Stimulus{.level = plan_.levels[order_[answered_]], .track = order_[answered_]};
}

Stimulus ConstantStimuli::again(const Stimulus& /*discarded*/) {
  const std::size_t block = plan_.levels.size() * plan_.per_block;
  const std::size_t left = block - answered_ % block;
  std::swap(order_[answered_], order_[answered_ + stream_.below(left)]);
  return choose().value();
}

}  // namespace presa::psychophysics
