#pragma once
#include <nlohmann/json.hpp>

#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa {

/// Plays the session's scene and adds what it costs to its description:
///   modules[] and stages[] median_ns, p999_ns, ticks, instructions_per_tick (null: what runs in one piece with others, or,
///   for instructions, valgrind is missing); cost: simulated_s, time and instructions, one sentence each on how they were
///   measured.
/// Takes a while: says on standard error what it does when somebody watches. The session is used up.
void addCost(nlohmann::json& run, const Inputs& inputs, const Loaded& loaded, Session& session);

}  // namespace presa
