#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "framework/core/math/random.h"

/// The fault table: faults during a grasp and the required reaction. Most runs are a whole pipeline in lockstep, with
/// two fingers on compliant hands holding an object and one fault at a random moment. Forces are judged as written to
/// the devices.
namespace presa::faults {

inline constexpr double kForever = std::numeric_limits<double>::infinity();  ///< [s]

/// Result of one run. A value that does not apply is 0.
struct Outcome {
  double detection = 0;             ///< from the fault to the first reduced force [s]
  double zero = 0;                  ///< from the fault to zero force at every affected device [s]
  double step = 0;                  ///< max change of a force between two writes [N]
  double energy = 0;                ///< max energy delivered to the hand from the fault until its end [J]
  double energy_allowed = 0;        ///< energy that sampling a spring may add [J]
  std::vector<std::string> broken;  ///< other violated requirements, in words
  /// Part of `detection` and of `zero` in which the machine ran neither the supervisor nor a witness beside it, plus the
  /// time in which the fault's moment is uncertain. The bounds are longer by it [s].
  double held_up_detection = 0, held_up_zero = 0;
  std::string delayed;  ///< a run that was within its bounds only thanks to that, in words; empty: none
  /// Attempts before this run in which the program never pressed, so that there was nothing to stop or kill.
  std::vector<std::string> not_started;
};

/// Bounds for every run; 0: none.
struct Bounds {
  double detection = 0, zero = 0;  ///< [s]
  bool energy = false;             ///< true: no energy may be delivered to the hand
};

struct Fault {
  int row = 0;  ///< row of the fault table
  std::string name, required;
  Bounds bounds;
  std::function<Outcome(RandomStream&)> run;
  int max_runs = std::numeric_limits<int>::max();  ///< limit for runs that take wall time or do not vary
  /// Runs real processes in real time; meaningless when the system refuses SCHED_FIFO (see realtimeRights).
  bool real_time = false;
};

/// The first violated requirement of a run; empty: none.
std::string brokenBy(const Fault& fault, const Outcome& outcome);

/// Faults while two fingers hold a cube (hold.h).
std::vector<Fault> holdFaults();

/// Faults of the whole program: real processes in real time, with a supervisor that survives the program (press.h).
/// `stall`: the supervisor itself is late with its first lower force by that time [s], to see the rows turn red.
std::vector<Fault> processFaults(double stall);

/// Faults of a Novint Falcon: its driver on a model of the device (devices/falcon_model), judged by the forces at the
/// model.
std::vector<Fault> falconFaults();

/// Faults of scene files, machine and rig (scene_faults.h).
std::vector<Fault> sceneFaults();

/// Viewers of a run on the bus (framework/bus).
std::vector<Fault> viewerFaults();

/// All faults in the order of the table.
std::vector<Fault> allFaults();

}  // namespace presa::faults
