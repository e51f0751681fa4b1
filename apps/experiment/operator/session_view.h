#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/method.h"
#include "framework/core/state/contact_exchange.h"

namespace presa::experiment {

/// What the operator is shown of a session, as plain values.
struct SessionView {
  struct Finger {
    std::string role;
    ContactMode mode = ContactMode::kNone;
    double force = 0;  ///< normal [N]
  };
  struct Watch {  ///< the number that the experiment wants to be seen, with its line
    std::string name, unit;
    double value = std::numeric_limits<double>::quiet_NaN(), line = std::numeric_limits<double>::quiet_NaN(), most = 0;
  };

  std::string title, subject, model;  ///< model: not empty when no person takes part
  int session = 1;
  int trial = 0, block = 0, attempt = 1;
  bool practice = false;
  std::size_t done = 0, left = 0, missing = 0;  ///< trials
  double seconds_left = 0;
  std::string condition;                   ///< in words
  std::string phase, instruction;          ///< instruction: what the participant is told in it
  double phase_time = 0, phase_limit = 0;  ///< [s]
  std::vector<Finger> fingers;
  Watch watch;
  bool device_lost = false;
  double clipped = 0;                         ///< time at the force limit in this trial [s]
  std::uint64_t missed = 0;                   ///< haptic ticks in this trial
  std::vector<psychophysics::Trial> answers;  ///< of the method that is going on
  std::string last;                           ///< what became of the trial before
  std::string asked;                          ///< what the operator wants and gets after this trial
  int notes = 0;
};

}  // namespace presa::experiment
