#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/record/recording.h"
#include "framework/scene/world.h"

namespace presa::replay_page {

/// Curves and states of the linked plots: {begin, width, count, every_tick, panels: [{title, unit, note, curves:
/// [{name, style, color, low, high}]}], states: [{name, seen}]}. Panels: normal force, tangential force with its limit
/// (static friction times normal force), grip (what two sides of a body both take: half of the amount by which the sum
/// of the commanded normal forces exceeds their resultant), height of the bodies that were touched, else of those that
/// move, joint angle and joint displacement (of the six positions that changed most). At most kMaxSignalBytes of base64 whatever the length. `surfaces_changed`: as Recording; may be empty.
/// `world`: null when the scene cannot be loaded; then no limit is known.
inline constexpr std::size_t kMaxSignalBytes = 1'400'000;
nlohmann::json signalsOf(const RecordedSamples& samples, const World* world,
                         const std::vector<std::uint8_t>& surfaces_changed);

/// Phases of the first finger that has some: [{name, begin, end}]. `names` by index, of a recording that has none itself;
/// others are "phase 3".
nlohmann::json phasesOf(const RecordedSamples& samples, const std::vector<std::string>& names);

}  // namespace presa::replay_page
