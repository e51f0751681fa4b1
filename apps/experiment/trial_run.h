#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/experiment/operator/operator_tap.h"
#include "experiments/runner/definition/presentation.h"
#include "experiments/runner/definition/trial.h"
#include "framework/device/device.h"

namespace presa::experiment {

struct TrialSetting {
  std::string record{};  ///< HDF5 file; empty: none
  bool realtime = false;
  bool window = false;                    ///< the participant sees the scene
  int subject = 1;                        ///< its number: which person a simulated subject is
  TrialLive* live = nullptr;              ///< what an operator sees; null: nobody looks
  std::function<bool()> stop{};           ///< asked now and then on the main thread: true ends the trial
  std::function<void(double)> on_time{};  ///< simulated time reached [s], now and then
};

struct TrialResult {
  Trial::State state = Trial::State::kRunning;
  bool stopped = false;  ///< by TrialSetting::stop
  std::string reason;    ///< of an abort
  std::vector<Trial::Stretch> phases;
  std::vector<double> values;  ///< of Experiment::names
  std::string excluded;        ///< rule that holds; empty: it counts
  double simulated_seconds = 0, wall_seconds = 0;
  std::uint64_t ticks = 0, missed = 0;  ///< of the haptic group
  std::vector<std::string> faults;      ///< of devices, dynamics and recording
  std::vector<DeviceFact> facts;        ///< of a simulated subject, drawn for this run
};

/// Runs one presentation of a trial in a session of its own, from the scene's start to the end of its last phase. `seed`: of the
/// trial. Throws InputError.
TrialResult present(const Experiment& experiment, const Presentation& presentation, std::uint64_t seed,
                    const TrialSetting& setting);

/// The traits of the simulated subject that takes part under this number: the same in all its runs; none for a person.
std::vector<DeviceFact> traitsOf(const Experiment& experiment, int subject);

}  // namespace presa::experiment
