#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/participant_screen.h"
#include "framework/scene/picture_options.h"
#include "framework/scene/scene.h"

namespace presa {

/// The simulated person who holds the simulated fingers. Takes precedence over the settings of the rig.
struct SimulatedPerson {
  std::uint64_t seed = 1,  ///< the same pair of seed and subject gives the same person in every run
      subject = 0;         ///< number of the person
  std::string level;       ///< detail level of the model; empty: the rig's
};

/// Settings of one run beyond the scene, from the command line or an experiment.
struct RunOptions {
  /// Whether the run draws: not at all, pictures and videos without a window, or a window.
  enum class View { kNone, kOffscreen, kWindow };
  bool realtime = false;            ///< by the clock, in threads; else in lockstep
  double duration = 10;             ///< simulated seconds
  std::uint64_t seed = 1;           ///< of random streams (RandomStream)
  View view = View::kNone;          ///< a window needs a screen
  std::string screenshot{};         ///< PNG path, may be empty
  double screenshot_time = -1;      ///< simulated time [s]; -1: at the end
  std::string screenshots{};        ///< folder for a series of pictures, one per `screenshot_every`; may be empty
  double screenshot_every = 0;      ///< interval in simulated time [s]
  std::string record{};             ///< HDF5 path, may be empty
  bool overwrite = false;           ///< `record` may replace an existing file
  std::vector<std::string> show{};  ///< overlays to show or hide in the picture: "haptic", "no-cones"
  /// The picture is for the participant of an experiment, and its window stays open for the next run of the process.
  /// The screen is what the window keeps showing between the runs; without bodies and fingertips it is black.
  std::optional<ParticipantScreen> participant{};
  std::string video{};   ///< MP4 path, may be empty
  std::string sound{};   ///< WAV path of what the scene's `<sound>` elements sound like; may be empty
  std::string flight{};  ///< HDF5 path for the last seconds before a fault, when `record` is empty; may be empty
  /// As `flight`, for a run that drives real hardware in real time.
  std::string hardware_flight{};
  bool allow_no_rt = false;  ///< hardware may run without real-time scheduling, at half the force
  double force_share = 1;    ///< fraction of the force limits that this run may use [-]
  bool bound_stiffness =
      false;  ///< reduce materials that are too stiff or too damped for the devices; otherwise the scene's are used
  std::optional<SimulatedPerson> person{};  ///< none: as the rig has it
  std::optional<BusSettings> bus{};         ///< takes precedence over rig and scene; network "none": no bus
  bool bus_commands = false;                ///< accept commands even if rig and scene do not

  /// Where the guide of the scene's assembly runs.
  enum class Guide {
    kBeside,                 ///< beside the dynamics
    kViewer                  ///< in a viewer that sends its decisions over the bus as commands
  } guide = Guide::kBeside;  ///< where it runs in this run
  PictureOptions picture{};  ///< how pictures and the window look
};

/// The bus on which the run publishes, or none. Precedence: run options, rig, scene.
std::optional<BusSettings> busOf(const Scene& scene, const Rig& rig, const RunOptions& options);
/// Sets `bus` and `bus_commands` to what holds for the run: the bus on which it publishes, or none; and whether
/// commands may change surfaces, over its bus or in a replay that repeats recorded commands.
void settleBus(const Scene& scene, const Rig& rig, RunOptions& options);

}  // namespace presa
