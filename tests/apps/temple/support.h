#pragma once
#include <string>

#include "apps/temple/building/building.h"
#include "apps/temple/building/scene_text.h"

namespace presa::temple::test {

/// A shipped building's proportions, with every `from` in its text replaced by `to`.
Proportions shippedWith(const std::string& name, const std::string& from = {}, const std::string& to = {});
Building shippedBuilding(const std::string& name, std::uint64_t seed = 1);

/// Max depth of sample points of A's shape inside B's and vice versa [m]; negative: the gap at the nearest sample
/// points. Corners, edges and faces are sampled.
double overlap(const Block& A, const Pose& X_WA, const Block& B, const Pose& X_WB);

/// A temporary folder of this process, removed when the tests pass.
std::string scratch(const std::string& name);

}  // namespace presa::temple::test
