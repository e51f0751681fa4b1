#pragma once
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa {

/// Shared objects mapped into this process now, by file name.
std::set<std::string> mappedLibraries();

/// Describes the session: its parts, the reasons for them, and the parts left out:
///   scene; threads[] name rate_hz period_s; modules[] name group reason; stages[] group module stage;
///   connections[] from to value across_rates [when_old old_after_s]; devices[] role driver; left_out[] what why;
///   joints[] name what, only in a scene with joints;
///   grasps[] body fingers stiffness_N_m mass_kg natural_frequency_hz explicit_min_mass_kg, only where fingers can
///   grasp a free body;
///   libraries[] name plugin needed_by ("the program": one of `before`; "the scene": loaded for it).
nlohmann::json describeSession(Session& session, const std::set<std::string>& before);

}  // namespace presa
