#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/joint_log.h"
#include "apps/common/tool_log.h"
#include "framework/core/schedule/tick.h"
#include "framework/core/schedule/timing_stats.h"
#include "framework/device/phase_intent.h"
#include "framework/record/monitor/monitor.h"
#include "framework/scene/world.h"

namespace presa {

/// All results of a finished run, as plain data: the only input of summary, report and closing lines.
/// Pointers stay valid as long as executor and monitor live.
struct RunResult {
  struct Rate {
    RateGroup group = RateGroup::kHaptic;
    double rate_hz = 0;
    const GroupTiming* timing = nullptr;  ///< never null
  };
  struct ContactPoint {
    std::string name;  ///< device role
    FingerSummary summary;
    std::vector<SlipOnset> slips;  ///< first kMaxSlipOnsets
  };
  /// A free body of the scene.
  struct Object {
    std::string name;
    std::int32_t body = kNoBody;   ///< index into Scene::bodies
    std::int32_t trace_slot = -1;  ///< index into TraceSample::bodies; -1: not traced
    double mass = 0;               ///< [kg]
    double friction_static = 0;    ///< of its material
    double friction_dynamic = 0;
    ObjectSummary summary;
  };
  /// A phase of a scripted motion.
  struct Phase {
    std::string name;
    double begin = 0, end = 0;  ///< [s]
    PhaseIntent intent = PhaseIntent::kNone;
  };
  struct Fault {
    double time = 0;  ///< simulated [s]
    std::string text;
  };
  /// A kind of haptic loss: how often it happened, and when first.
  struct Loss {
    std::uint32_t count = 0;
    double first = -1;  ///< [s]; -1: never
  };
  /// How many places of the scene's assembly are filled.
  struct Assembly {
    int goals = 0, filled = 0;
  };
  struct Recording {
    std::string file;  ///< empty: not recorded
    std::uint64_t rows = 0;
    std::uint64_t dropped = 0;
  };

  std::shared_ptr<const World> world;  ///< scene and rig; never null
  std::string version;                 ///< of the program
  std::string started;                 ///< wall clock with its zone, "2026-03-01 10:30:00 +0100"; empty: not known
  std::string command;                 ///< command line that repeats the run
  std::uint64_t seed = 1;
  bool realtime = false;
  bool interrupted = false;  ///< stopped by the user before its end
  double stopped_at = -1;    ///< begin of the fade of forces after a stop [s]; -1: the run came to its end
  double simulated_seconds = 0;
  double wall_seconds = 0;
  std::vector<std::string> realtime_missing;  ///< refused real-time settings ("SCHED_FIFO 80: not permitted")
  std::vector<Rate> rates;                    ///< groups that ran, in the order of RateGroup
  std::vector<ContactPoint> contact_points;   ///< as Scene::devices
  Loss coverage_lost;  ///< ticks in which a fingertip missed surfaces in its reach, all fingers together
  std::vector<Object> objects;
  std::optional<Assembly> assembly;                 ///< none: the scene has none
  std::vector<Phase> phases;                        ///< empty for a real hand
  const BoundedList<TraceSample>* trace = nullptr;  ///< null: none
  /// A frame of the rig that its user may move, or whose tool was lost.
  struct DrivenFrame {
    std::string name;
    std::uint32_t uses = 0, refusals = 0;  ///< walks, clutches and zooms begun, and those that a force held up
    std::uint32_t losses = 0;              ///< of the tool that carries it
    double zoom = 1;                       ///< at the end
  };
  std::vector<DrivenFrame> frames;
  const JointLog* joints = nullptr;  ///< null: the scene has none
  std::vector<ToolSummary> tools;    ///< tools with volume, in the order of their roles
  std::vector<Fault> faults;
  std::vector<std::string> load_warnings;  ///< repaired meshes and the like, as printed ("a.xml:1:2: warning[W307]: …")
  std::vector<std::string> notes;          ///< stiffness bounds, raised damping, skipped parts, …
  std::string screenshot;                  ///< PNG path, may be empty
  std::optional<double> sharpness;         ///< View::sharpness of the last frame; none: no window
  Recording recording;
  std::vector<std::string> flight_records;  ///< files with the seconds around each fault, if the run was not recorded
  EnergyCreated energy_created;             ///< in the dynamics; NaN: not known
  std::uint64_t too_many_held = 0;          ///< times that a group was too large for the haptic thread to move
  std::uint64_t stopped_short = 0;          ///< times that a body was stopped short of passing through another
  double far_lag = 0;                  ///< for which bodies out of reach stood still, as the dynamics were late [s]
  std::uint64_t solver_fallbacks = 0;  ///< dynamics steps in which the direct solver gave up on an island
  std::uint64_t state_hash = 0;
};

/// Fills contact points, objects, trace, hash and simulated time from the monitor, after the run.
/// `result.world` must be set. Device roles name the contact points.
void takeMonitor(const Monitor& monitor, RunResult& result);

/// The first phases in a row with this intent, or none.
std::optional<PhaseSpan> spanOf(const RunResult& result, PhaseIntent intent);

}  // namespace presa
