#include "experiments/runner/psychophysics/forced_choice.h"

#include <stdexcept>
#include <utility>

namespace presa::psychophysics {

ForcedChoice::ForcedChoice(std::unique_ptr<Method> method, ForcedChoicePlan plan, const RandomStream& stream)
    : method_(std::move(method)), plan_(plan), stream_(stream) {
  if (!method_) throw std::invalid_argument("forced choice needs a method that chooses the level");
  if (plan_.task == Task::kAdjust || (method_->next() && method_->next()->kind == TrialKind::kAdjustment)) {
    throw std::invalid_argument("forced choice cannot go with the method of adjustment");
  }
  if (plan_.balance_over == 0) throw std::invalid_argument("balance_over (trials) must be > 0");
  start();
}

bool ForcedChoice::isPositive(const Stimulus& stimulus, int chosen) const {
  const bool yes_no = plan_.task == Task::kYesNo;
  const bool comparison = yes_no ? chosen == 1 : chosen != stimulus.standard_place;
  const bool said_greater = comparison != plan_.asks_for_less;
  if (plan_.coding == Coding::kGreater) return said_greater;
  if (yes_no) return comparison == (stimulus.level != 0);
  return said_greater == (stimulus.level >= 0);
}

Response ForcedChoice::responseFor(bool positive) const {
  const int chosen = isPositive(next().value(), 1) == positive ? 1 : 2;
  return {.positive = positive, .chosen = chosen};
}

void ForcedChoice::update(Trial& trial) {
  const int chosen = trial.response->chosen;
  if (chosen != 1 && chosen != 2) throw std::invalid_argument("a forced choice is 1 or 2");
  trial.response->positive = isPositive(trial.stimulus, chosen);
  method_->respond(*trial.response);
}

std::optional<Stimulus> ForcedChoice::choose() {
  std::optional<Stimulus> stimulus = method_->next();
  if (stimulus && plan_.task != Task::kYesNo) stimulus->standard_place = drawPlace(stimulus->track);
  return stimulus;
}

Stimulus ForcedChoice::again(const Stimulus& discarded) {
  method_->discard();
  if (plan_.task != Task::kYesNo) {  // reinsert the place at random, so that the balance holds
    std::vector<int>& left = places_left_[discarded.track];
    left.push_back(discarded.standard_place);
    stream_.shuffle(std::span<int>(left));
  }
  return choose().value();
}

int ForcedChoice::drawPlace(std::size_t track) {
  std::vector<int>& left = places_left_[track];
  if (left.empty()) {
    const std::size_t each = (plan_.balance_over + 1) / 2;
    left.insert(left.end(), each, 1);
    left.insert(left.end(), each, 2);
    stream_.shuffle(std::span<int>(left));
  }
  const int place = left.back();
  left.pop_back();
  return place;
}

}  // namespace presa::psychophysics
