#include <cmath>
#include <numbers>

#include "apps/experiment/respondent.h"
#include "framework/core/math/random.h"

namespace presa::experiment {
namespace {

using psychophysics::AdjustmentKey;

constexpr double kQuartile = 0.6744897501960817;  // upper quartile of the standard normal distribution

class SimulatedRespondent final : public Respondent {
 public:
  SimulatedRespondent(const Experiment& experiment, int subject_number)
      : experiment_(experiment), observer_(*experiment.procedure->observer) {
    for (const std::string& name : observer_.percept) percept_.push_back(*experiment.names.find(name));
    RandomStream person(experiment.seed, "observer", static_cast<std::uint64_t>(subject_number));
    weber_ = person.logNormal(observer_.weber, observer_.spread);
  }

  std::optional<int> choose(const PlannedTrial& trial, std::span<const TrialResult> presented) override {
    RandomStream random(trial.seed, "answer");
    const bool guesses = random.uniform() < observer_.lapse;
    const double a = noisy(presented.front().values[percept_.front()], random);
    double b = std::log(observer_.criterion);
    if (experiment_.procedure->task != Task::kYesNo) b = noisy(presented.back().values[percept_.back()], random);
    const bool unfelt = std::isnan(a) || std::isnan(b);
    if (guesses || unfelt) return random.below(2) == 0 ? 1 : 2;
    return (a > b) != experiment_.procedure->asks_for_less ? 1 : 2;
  }

  std::optional<AdjustmentKey> adjust(const PlannedTrial& trial, const TrialResult& standard,
                                      const TrialResult& comparison, int round) override {
    RandomStream random(trial.seed, "adjust", static_cast<std::uint64_t>(round));
    double excess =
        noisy(comparison.values[percept_.front()], random) - noisy(standard.values[percept_.front()], random);
    if (!(std::abs(excess) > weber_ / 2)) return AdjustmentKey::kConfirm;
    if (experiment_.procedure->asks_for_less) excess = -excess;
    if (std::abs(excess) > 2 * weber_) return excess > 0 ? AdjustmentKey::kDown : AdjustmentKey::kUp;
    return excess > 0 ? AdjustmentKey::kDownFine : AdjustmentKey::kUpFine;
  }

 private:
  /// Log of the percept with Gaussian noise, scaled so that a ratio of 1 + weber is discriminated in 75 % of pairs.
  double noisy(double percept, RandomStream& random) const {
    const double sd = std::log1p(weber_) / (kQuartile * std::numbers::sqrt2);
    return std::log(percept) + sd * random.normal();
  }

  const Experiment& experiment_;
  const SimulatedObserver& observer_;
  std::vector<std::size_t> percept_;  // slots of Experiment::names
  double weber_;
};

}  // namespace

std::unique_ptr<Respondent> simulatedRespondent(const Experiment& experiment, int subject_number) {
  return std::make_unique<SimulatedRespondent>(experiment, subject_number);
}

}  // namespace presa::experiment
