#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/experiment/operator/operator_observer.h"
#include "experiments/runner/definition/presentation.h"
#include "experiments/runner/definition/trial.h"
#include "framework/device/device.h"

namespace presa::experiment {

struct TrialSetting {
  std::string record{};  ///< HDF5 file; empty: no recording
  bool realtime = false;
  bool window = false;                    ///< the participant has a window
  std::string language = "en";            ///< of the texts in it
  bool asks = false;                      ///< the question follows this presentation
  int subject = 1;                        ///< number of the subject; selects the simulated person
  TrialLive* live = nullptr;              ///< live values for the operator; null: no display
  std::function<bool()> stop{};           ///< polled on the main thread: true ends the trial
  std::function<void(double)> on_time{};  ///< called regularly with the simulated time [s]
};

struct TrialResult {
  Trial::State state = Trial::State::kRunning;
  bool stopped = false;  ///< by TrialSetting::stop
  std::string reason;    ///< reason of an abort
  std::vector<Trial::Stretch> phases;
  std::vector<double> values;  ///< values of Experiment::names
  std::string excluded;        ///< exclusion rule that was met; empty: the trial counts
  double simulated_seconds = 0, wall_seconds = 0;
  std::uint64_t ticks = 0, missed = 0;  ///< ticks of the haptic group
  std::vector<std::string> faults;      ///< faults of devices, dynamics and recording
  std::vector<DeviceFact> facts;        ///< facts about a simulated subject, drawn for this run
};

/// Runs one presentation of a trial in a Session of its own, from the scene's start to the end of the last phase.
/// `seed`: seed of the presentation. Throws InputError.
TrialResult present(const Experiment& experiment, const Presentation& presentation, std::uint64_t seed,
                    const TrialSetting& setting);

/// The parameters of the simulated subject with this number, the same in all its runs; empty for a person.
std::vector<DeviceFact> traitsOf(const Experiment& experiment, int subject);

}  // namespace presa::experiment
