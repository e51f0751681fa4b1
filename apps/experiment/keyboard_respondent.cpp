#include "apps/experiment/respondent.h"

namespace presa::experiment {
namespace {

class KeyboardRespondent final : public Respondent {
 public:
  KeyboardRespondent(const Experiment& experiment, Operator& person, const std::string& language)
      : operator_(person), question_(experiment.textFor("question", language)) {}

  std::optional<int> choose(const PlannedTrial&, std::span<const TrialResult>) override {
    return operator_.ask(question_);
  }
  std::optional<psychophysics::AdjustmentKey> adjust(const PlannedTrial&, const TrialResult&, const TrialResult&,
                                                     int) override {
    return operator_.askAdjust(question_);
  }

 private:
  Operator& operator_;
  std::string question_;
};

}  // namespace

std::unique_ptr<Respondent> keyboardRespondent(const Experiment& experiment, Operator& person,
                                               const std::string& language) {
  return std::make_unique<KeyboardRespondent>(experiment, person, language);
}

}  // namespace presa::experiment
