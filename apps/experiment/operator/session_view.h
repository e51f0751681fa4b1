#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/method.h"
#include "framework/core/state/contact_exchange.h"

namespace presa::experiment {

/// The state of a session as shown to the operator, as plain values.
struct SessionView {
  struct FingerStatus {
    std::string role;
    ContactMode mode = ContactMode::kNone;
    double force = 0;  ///< normal [N]
  };
  struct Watch {  ///< the quantity that the experiment displays, with its reference line
    std::string name, unit;
    double value = std::numeric_limits<double>::quiet_NaN(), line = std::numeric_limits<double>::quiet_NaN(), max = 0;
  };

  std::string title, subject, model;  ///< model: not empty for a simulated subject
  int session = 1;
  int trial = 0, block = 0, attempt = 1;
  bool practice = false;
  std::size_t done = 0, left = 0, missing = 0;  ///< trials
  double seconds_left = 0;
  std::string condition;                   ///< as text
  std::string phase, instruction;          ///< instruction: text for the participant in this phase
  double phase_time = 0, phase_limit = 0;  ///< [s]
  std::vector<FingerStatus> fingers;
  Watch watch;
  bool device_lost = false;
  double clipped = 0;                         ///< time at the force limit in this trial [s]
  std::uint64_t missed = 0;                   ///< haptic ticks missed in this trial
  std::vector<psychophysics::Trial> answers;  ///< answers of the running method
  std::string last;                           ///< outcome of the previous trial
  std::string asked;                          ///< the operator's request that takes effect after this trial
  int notes = 0;
};

}  // namespace presa::experiment
