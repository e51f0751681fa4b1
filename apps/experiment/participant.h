#pragma once
#include <atomic>
#include <string>
#include <vector>

#include "apps/experiment/trial_observer.h"
#include "framework/session/view.h"

namespace presa::experiment {

/// What the participant sees while this phase lasts, with the instruction in `language`.
ParticipantScreen screenIn(const Experiment& experiment, const Phase& phase, const std::string& language);

/// What the window shows when a presentation has ended: black, with question and answers if they are asked for now.
ParticipantScreen screenAfter(const Experiment& experiment, const std::string& language, bool asks);

/// Black, with a text: before the first trial and in a rest.
ParticipantScreen screenWith(const std::string& text);

/// Shows each phase's screen when the trial enters it. Thread: view; the view must belong to the same run.
class ParticipantDirector final : public Module {
 public:
  ParticipantDirector(const TrialObserver& trial, std::vector<ParticipantScreen> by_phase)
      : Module("participant", RateGroup::kView), trial_(trial), by_phase_(std::move(by_phase)) {}
  void showOn(View* view) noexcept { view_.store(view, std::memory_order_relaxed); }

  void step(const Tick&) noexcept override {
    View* const view = view_.load(std::memory_order_relaxed);
    const std::size_t phase = trial_.phase();
    if (view == nullptr || phase == shown_ || phase >= by_phase_.size()) return;
    shown_ = phase;
    view->setScreen(by_phase_[phase]);
  }
  std::vector<std::string> stages() const override { return {"show the participant what the phase lets them see"}; }

 private:
  const TrialObserver& trial_;
  const std::vector<ParticipantScreen> by_phase_;
  std::atomic<View*> view_{nullptr};
  std::size_t shown_ = static_cast<std::size_t>(-1);
};

}  // namespace presa::experiment
