#include "apps/experiment/conduct.h"

#include <algorithm>

#include "framework/core/schedule/clock.h"

namespace presa::experiment {
namespace {

class Conductor {
 public:
  Conductor(const Experiment& experiment, const PlannedTrial& trial, const std::vector<std::string>& files,
            const TrialSetting& setting, Respondent* respondent)
      : experiment_(experiment), trial_(trial), files_(files), setting_(setting), respondent_(respondent) {}

  Conducted run() {
    const bool adjusts = experiment_.procedure && experiment_.procedure->task == Task::kAdjust;
    if (!(adjusts ? adjust() : presentAll())) return judged();
    if (!experiment_.procedure || adjusts) return judged();
    if (const auto chosen = respondent_->choose(trial_, result_.presented))
      result_.response = psychophysics::Response{.chosen = *chosen};
    else
      result_.unanswered = true;
    return judged();
  }

 private:
  bool presentAll() {
    const std::vector<Presentation> all = presentationsOf(experiment_, trial_);
    for (const Presentation& presentation : all) {
      if (!result_.presented.empty() && !pause()) return false;
      const bool is_last = result_.presented.size() + 1 == all.size();
      if (!show(presentation, is_last && experiment_.procedure)) return false;
    }
    return true;
  }

  /// Method of adjustment: presents the standard and the comparison in turn until the level is confirmed.
  bool adjust() {
    const auto& plan = std::get<psychophysics::AdjustmentPlan>(experiment_.procedure->plan);
    psychophysics::Adjuster adjuster(plan, trial_.stimulus->level);
    const Presentation standard = presentationsOf(experiment_, trial_).front();
    for (int round = 1; round <= static_cast<int>(experiment_.procedure->rounds); ++round) {
      if (!show(standard, false) || !pause()) return false;
      if (!show(comparisonAt(experiment_, trial_, adjuster.level()), true)) return false;
      const auto key = respondent_->adjust(trial_, *(result_.presented.end() - 2), result_.presented.back(), round);
      if (!key) {
        result_.unanswered = true;
        return false;
      }
      adjuster.press(*key);
      if (!adjuster.done()) continue;
      result_.response = psychophysics::Response{.value = adjuster.level()};
      return true;
    }
    too_long_ = true;
    return false;
  }

  /// Runs one presentation, `asks`: before the question. False: the trial ended in it.
  bool show(const Presentation& presentation, bool asks) {
    TrialSetting setting = setting_;
    setting.asks = asks;
    if (!files_.empty()) setting.record = files_[result_.presented.size()];
    // each presentation has its own random stream; the first one has the trial's seed
    const std::uint64_t seed = trial_.seed + result_.presented.size();
    result_.presented.push_back(present(experiment_, presentation, seed, setting));
    const TrialResult& shown = result_.presented.back();
    return shown.state == Trial::State::kDone && shown.faults.empty();
  }

  /// Waits between two presentations. False: the operator ended the trial meanwhile.
  bool pause() {
    if (!setting_.realtime) return true;
    const std::int64_t until = monotonicNs() + static_cast<std::int64_t>(experiment_.procedure->gap * 1e9);
    for (std::int64_t now = monotonicNs(); now < until; now = monotonicNs()) {
      sleepUntilNs(std::min(until, now + 20'000'000));
      if (setting_.on_time) setting_.on_time(result_.presented.back().simulated_seconds);
      if (setting_.stop && setting_.stop()) {
        result_.unanswered = true;
        return false;
      }
    }
    return true;
  }

  Conducted judged() {
    const TrialResult& last = result_.presented.back();
    for (const TrialResult& shown : result_.presented) {
      if (result_.excluded.empty()) result_.excluded = shown.excluded;
    }
    if (!last.faults.empty()) {
      result_.reason = last.faults.front();
    } else if (last.stopped || result_.unanswered) {
      result_.reason = "stopped by the operator";
    } else if (last.state != Trial::State::kDone || too_long_) {
      result_.outcome = Outcome::kAborted;
      result_.reason = too_long_ ? "not confirmed within the rounds there are" : last.reason;
    } else {
      result_.outcome = Outcome::kDone;
    }
    return std::move(result_);
  }

  const Experiment& experiment_;
  const PlannedTrial& trial_;
  const std::vector<std::string>& files_;
  const TrialSetting& setting_;
  Respondent* respondent_;
  Conducted result_;
  bool too_long_ = false;
};

}  // namespace

Conducted conduct(const Experiment& experiment, const PlannedTrial& trial, const std::vector<std::string>& files,
                  const TrialSetting& setting, Respondent* respondent) {
  return Conductor(experiment, trial, files, setting, respondent).run();
}

}  // namespace presa::experiment
