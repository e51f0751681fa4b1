#include "apps/experiment/participant.h"

namespace presa::experiment {

ParticipantScreen screenIn(const Experiment& experiment, const Phase& phase, const std::string& language) {
  const Sight& sees = phase.sees;
  return {.bodies = sees.bodies,
          .fingertips = sees.fingertips,
          .measured = sees.measured,
          .fixation = sees.fixation,
          .text = sees.instruction ? experiment.textFor(phase.name, language) : ""};
}

ParticipantScreen screenAfter(const Experiment& experiment, const std::string& language, bool asks) {
  return {.bodies = false,
          .fingertips = false,
          .fixation = experiment.sees.fixation && !asks,
          .text = asks && experiment.sees.question ? experiment.textFor("question", language) : ""};
}

}  // namespace presa::experiment
