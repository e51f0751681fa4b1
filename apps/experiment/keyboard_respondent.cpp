#include "apps/experiment/respondent.h"

namespace presa::experiment {
namespace {

class KeyboardRespondent final : public Respondent {
 public:
  KeyboardRespondent(const Experiment& experiment, Operator& person, ParticipantDesk& desk, const std::string& language)
      : operator_(person), desk_(desk), question_(experiment.textFor("question", language)) {}

  std::optional<int> choose(const PlannedTrial&, std::span<const TrialResult>) override {
    desk_.ask();
    const auto answer = operator_.ask(question_);
    desk_.leave();
    return answer;
  }
  std::optional<psychophysics::AdjustmentKey> adjust(const PlannedTrial&, const TrialResult&, const TrialResult&,
                                                     int) override {
    desk_.ask();
    const auto key = operator_.askAdjust(question_);
    desk_.leave();
    return key;
  }

 private:
  Operator& operator_;
  ParticipantDesk& desk_;
  std::string question_;
};

}  // namespace

std::unique_ptr<Respondent> keyboardRespondent(const Experiment& experiment, Operator& person, ParticipantDesk& desk,
                                               const std::string& language) {
  return std::make_unique<KeyboardRespondent>(experiment, person, desk, language);
}

}  // namespace presa::experiment
