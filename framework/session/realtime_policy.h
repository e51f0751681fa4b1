#pragma once
#include <string>
#include <vector>

#include "framework/session/plan.h"
#include "framework/session/realtime_rights.h"

namespace presa {

/// Whether one of these drivers moves hardware. Loads the plug-ins; skips those that do not load (createDevices reports
/// them).
bool drivesHardware(const std::vector<PlannedDevice>& devices);

/// Share of the force limits that a run may use. Without SCHED_FIFO and locked memory, other programs could delay the
/// haptic thread while hardware holds a force. If the system refuses them for hardware in real time, this throws
/// InputError E463, or, if the user allows it, returns kShareWithoutRights with a note in `notes`. Models and lockstep
/// runs get 1; the probe is not called.
double forceShare(bool hardware, const RunOptions& options, const RealtimeProbe& probe,
                  std::vector<std::string>& notes);

/// The supervisor of real hardware drops the force when no command comes for CommandKeeper::kHold. A haptic rate with
/// fewer than two commands in that time is refused: E410, at the rig's device. Loads the plug-ins.
void checkCommandRate(const Scene& scene, const Rig& rig, const Plan& plan, Diagnostics& diagnostics);

inline constexpr double kShareWithoutRights = 0.5;

}  // namespace presa
