#pragma once
#include <string>
#include <vector>

#include "apps/temple/building/block.h"

namespace presa::temple {

/// Blocks that fit where block `i` belongs, itself among them: of the same kind and shape, whatever has broken off.
std::vector<std::size_t> fitting(const Building& building, std::size_t i);
/// Blocks on which block `i` rests where it belongs.
std::vector<std::size_t> supporting(const Building& building, std::size_t i);
/// The scene's <assembly>: a goal for every block, named as the block, after those that carry it. `field`: edges of the box on
/// the ground out of which nothing gets [m].
std::string assemblyText(const Building& building, const Vec3& field, const AssemblyWords& words = {},
                         double spent = 0);

}  // namespace presa::temple
