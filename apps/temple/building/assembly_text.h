#pragma once
#include <string>
#include <vector>

#include "apps/temple/building/block.h"

namespace presa::temple {

/// Blocks that fit into the goal of block `i`, itself included: blocks of the same kind and shape. Chips are ignored.
std::vector<std::size_t> fitting(const Building& building, std::size_t i);
/// Blocks on which block `i` rests in the finished building.
std::vector<std::size_t> supporting(const Building& building, std::size_t i);
/// The scene's <assembly>: a goal for every block, named as the block, to be filled after the blocks that support it.
/// `workspace`: edges of the workspace [m], a box on the ground that no block can leave.
std::string assemblyText(const Building& building, const Vec3& workspace, const AssemblyWords& words = {},
                         double elapsed = 0);

}  // namespace presa::temple
