#include "experiments/runner/psychophysics/quest_plus.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace presa::psychophysics {
namespace {

/// Entropy of an answer that is positive with probability p, strictly between 0 and 1 [nat].
double answerEntropy(double p) { return -p * std::log(p) - (1 - p) * std::log1p(-p); }

QuestPlusPlan checked(QuestPlusPlan plan) {
  requireNone(mistakes(plan));
  return plan;
}

}  // namespace

std::vector<std::string> mistakes(const QuestPlusPlan& plan) {
  std::vector<std::string> found = mistakes(plan.grid);
  if (plan.levels.empty() || !std::ranges::all_of(plan.levels, [](double level) { return std::isfinite(level); })) {
    found.emplace_back("the levels to choose from must be given and be finite");
  }
  if (plan.stop_trials == 0) found.emplace_back("the max number of trials must be > 0");
  if (!(plan.stop_sd >= 0)) found.emplace_back("the posterior sd to stop at must be >= 0");
  return found;
}

QuestPlus::QuestPlus(QuestPlusPlan plan) : plan_(checked(std::move(plan))), posterior_(plan_.grid) {
  probability_.reserve(plan_.levels.size() * posterior_.size());
  for (const double level : plan_.levels) {
    for (std::size_t cell = 0; cell < posterior_.size(); ++cell) {
      probability_.push_back(posterior_.probability(cell, level));
    }
  }
  answer_entropy_.resize(probability_.size());
  std::ranges::transform(probability_, answer_entropy_.begin(), answerEntropy);
  start();
}

/// Expected decrease of the posterior entropy, computed as the mutual information of parameters and answer, H(answer) -
/// E H(answer | parameters), which needs no logarithm per cell and trial.
std::vector<double> QuestPlus::expectedInformation() const {
  std::vector<double> information;
  const std::span<const double> weights = posterior_.weights();
  for (std::size_t level = 0; level < plan_.levels.size(); ++level) {
    const double* const probability = &probability_[level * weights.size()];
    const double* const entropy = &answer_entropy_[level * weights.size()];
    double positive = 0, known = 0;
    for (std::size_t cell = 0; cell < weights.size(); ++cell) {
      positive += weights[cell] * probability[cell];
      known += weights[cell] * entropy[cell];
    }
    information.push_back(answerEntropy(positive) - known);
  }
  return information;
}

std::vector<double> QuestPlus::expectedEntropy() const {
  std::vector<double> expected = expectedInformation();
  const double now = posterior_.entropy();
  for (double& entropy : expected) entropy = now - entropy;
  return expected;
}

void QuestPlus::update(Trial& trial) {
  posterior_.update(std::span(probability_).subspan(chosen_ * posterior_.size(), posterior_.size()),
                    trial.response->positive);
  ++answers_;
}

std::optional<Stimulus> QuestPlus::choose() {
  const bool sure = plan_.stop_sd > 0 && posterior_.sd(Parameter::kThreshold) <= plan_.stop_sd;
  if (sure || answers_ >= plan_.stop_trials) return std::nullopt;
  const std::vector<double> information = expectedInformation();
  chosen_ = static_cast<std::size_t>(std::ranges::max_element(information) - information.begin());
  return Stimulus{.level = plan_.levels[chosen_]};
}

}  // namespace presa::psychophysics
