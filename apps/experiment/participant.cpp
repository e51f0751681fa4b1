#include "apps/experiment/participant.h"

namespace presa::experiment {
namespace {

/// The experiment's words for the keys, or the keys themselves, which need no language.
std::string answersFor(const Experiment& experiment, const std::string& language) {
  const std::string words = experiment.textFor("answers", language);
  if (!words.empty() || !experiment.procedure) return words;
  return experiment.procedure->task == Task::kAdjust ? "+  -     .  ,     \xe2\x8e\xb5" : "1     2";
}

}  // namespace

ParticipantScreen screenIn(const Experiment& experiment, const Phase& phase, const std::string& language) {
  const Sight& sees = phase.sees;
  return {.bodies = sees.bodies,
          .fingertips = sees.fingertips,
          .measured = sees.measured,
          .fixation = sees.fixation,
          .text = sees.instruction ? experiment.textFor(phase.name, language) : ""};
}

ParticipantScreen screenAfter(const Experiment& experiment, const std::string& language, bool asks) {
  ParticipantScreen screen = screenWith("");
  screen.fixation = experiment.sees.fixation && !asks;
  if (asks && experiment.sees.question) screen.text = experiment.textFor("question", language);
  if (!asks || !experiment.sees.answers) return screen;
  const std::string answers = answersFor(experiment, language);
  if (!answers.empty()) screen.text += (screen.text.empty() ? "" : "\n") + answers;
  return screen;
}

ParticipantScreen screenWith(const std::string& text) { return {.bodies = false, .fingertips = false, .text = text}; }

}  // namespace presa::experiment
