#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/temple/building/block.h"

namespace presa::temple {

/// Ruins that were strewn before, kept in the user's cache (framework/input/cache.h) under a hash of the building, the
/// seed and this build, because a front's drop takes seconds. strewRuins() would give the same poses. Thread: main.

/// The ruins of a shipped building (`size`: column or facade) with the first seed, from `config/temple/ruins_SIZE.json`,
/// so that the very first start shows its picture at once; none of any other. A test compares them with strewRuins().
std::optional<std::vector<Pose>> shippedRuins(const std::string& size, std::uint64_t seed);

/// The file for these ruins; "" when the user has no cache, or this build's sources differ from their commit, so that a
/// developer sees what changed code does.
std::string ruinsCacheFile(const Building& building, std::uint64_t seed);
/// The pose of each block; none when there is no such file, or it is damaged.
std::optional<std::vector<Pose>> readRuins(const std::string& file, const Building& building);
/// What keepRuins() writes, and config/temple has.
std::string ruinsText(const Building& building, std::uint64_t seed, const std::vector<Pose>& X_WB);
/// A file that cannot be written is none.
void keepRuins(const std::string& file, const Building& building, std::uint64_t seed, const std::vector<Pose>& X_WB);

}  // namespace presa::temple
