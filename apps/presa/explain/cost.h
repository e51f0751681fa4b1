#pragma once
#include <nlohmann/json.hpp>

#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa {

/// Runs the session's scene and adds its cost to the description:
///   modules[] median_ns, p999_ns, ticks, share_of_period (median over the period of the module's group);
///   cost: simulated_s, time (one sentence on how it was measured).
/// Takes a while: reports progress on standard error if that is a terminal. The session cannot be run again.
void addCost(nlohmann::json& run, Session& session);

}  // namespace presa
