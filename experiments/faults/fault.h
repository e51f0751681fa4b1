#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "framework/core/math/random.h"

/// What may go wrong under a hand, and what must happen then. Every run is a whole pipeline in lockstep, two yielding fingers on an
/// object, one fault at a random moment; forces are judged as they were written to the devices.
namespace presa::faults {

/// What one run showed. A value that does not apply is 0.
struct Outcome {
  double detection = 0;             ///< from the fault to the first force that answers it [s]
  double zero = 0;                  ///< from the fault to zero force at every device concerned [s]
  double step = 0;                  ///< largest change of a force from one write to the next [N]
  double energy = 0;                ///< most given to the hand from the fault until zero, or until the fault's end [J]
  double energy_allowed = 0;        ///< what the sampling of a spring may add to that [J]
  std::vector<std::string> broken;  ///< what else was required and did not happen
  /// Runs before it of which nobody could have told when the fault came: why, each with its figure.
  std::vector<std::string> discarded;
};

/// Bounds that hold for every run; 0: none.
struct Bounds {
  double detection = 0, zero = 0;  ///< [s]
  bool energy = false;             ///< none to the hand
};

struct Fault {
  int row = 0;  ///< of the fault table
  std::string name, required;
  Bounds bounds;
  std::function<Outcome(RandomStream&)> run;
  int most_runs = std::numeric_limits<int>::max();  ///< where a run takes wall time or says no more than the one before
  /// Real processes against the clock: means nothing where the system refuses SCHED_FIFO (realtimeRights).
  bool real_time = false;
};

/// What a run broke; empty: nothing.
std::string brokenBy(const Fault& fault, const Outcome& outcome);

/// Faults under two fingers that hold a cube (hold.h).
std::vector<Fault> holdFaults();

/// Faults of the whole program, with a supervisor that outlives it: real processes in real time (press.h).
std::vector<Fault> processFaults();

/// Faults of a Novint Falcon, its driver on a model of the device (devices/falcon_model); forces are those that the model received.
std::vector<Fault> falconFaults();

/// Faults of what a scene is made from, of the machine and of the rig (scene_faults.h).
std::vector<Fault> sceneFaults();

/// Faults of those who look at a run (framework/bus).
std::vector<Fault> viewerFaults();

/// Of every family, in the order of the table.
std::vector<Fault> allFaults();

}  // namespace presa::faults
