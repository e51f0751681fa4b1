#pragma once
#include <string>

#include "apps/temple/building/building.h"
#include "apps/temple/building/scene_text.h"

namespace presa::temple::test {

/// A shipped building's proportions; its text with every `from` replaced by `to` where given.
Proportions shippedWith(const std::string& name, const std::string& from = {}, const std::string& to = {});
Building shippedBuilding(const std::string& name, std::uint64_t seed = 1);

/// How far points of A's shape lie inside B's and the other way round, at most [m]; negative: what is between them at least where
/// points of either come nearest. Corners, edges and faces are sampled.
double overlap(const Block& A, const Pose& X_WA, const Block& B, const Pose& X_WB);

/// A folder of this test's own, removed when the process ends well.
std::string scratch(const std::string& name);

}  // namespace presa::temple::test
