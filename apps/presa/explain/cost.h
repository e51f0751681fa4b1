#pragma once
#include <nlohmann/json.hpp>

#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa {

/// Plays the session's scene and adds what it costs to its description:
///   modules[] median_ns, p999_ns, ticks, share_of_period (median over the period of the module's group);
///   cost: simulated_s, time (one sentence on how it was measured).
/// Takes a while: says on standard error what it does when somebody watches. The session is used up.
void addCost(nlohmann::json& run, const Loaded& loaded, Session& session);

}  // namespace presa
