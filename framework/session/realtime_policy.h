#pragma once
#include <string>
#include <vector>

#include "framework/core/schedule/realtime_rights.h"
#include "framework/session/plan.h"

namespace presa {

/// A driver of the plan moves hardware. Loads the plug-ins; one that cannot be loaded is passed over, createDevices() says it.
bool drivesHardware(const Plan& plan);

/// Share of the force limits that a run may use. Hardware must not hold a force for as long as other programs please: where the clock
/// runs it and the system refuses SCHED_FIFO or locked memory, this throws InputError E463, or, where the user allows it, gives
/// kShareWithoutRights and says so in `notes`. Models, and lockstep, are not concerned: the probe is not asked.
double forceShare(bool hardware, const RunOptions& options, const RealtimeProbe& probe,
                  std::vector<std::string>& notes);

/// The supervisor of real hardware takes a force away when no command comes for CommandKeeper::kHold. A haptic rate that gives it
/// fewer than two in that time contradicts it: E410, at the rig's device. Loads the plug-ins.
void checkCommandRate(const Scene& scene, const Rig& rig, const Plan& plan, Diagnostics& diagnostics);

inline constexpr double kShareWithoutRights = 0.5;

}  // namespace presa
