#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/temple/building/block.h"

namespace presa::temple {

struct Ruins {
  std::vector<Pose> X_WB;        ///< pose of each block
  double simulated_seconds = 0;  ///< total over all runs
  double still = 0;              ///< max displacement of a block in the last second [m]
};

/// Called after each round with the number of blocks at rest and of all blocks; return false to stop.
using RuinsProgress = std::function<bool(std::size_t lying, std::size_t all, const std::string& what)>;

/// Where the blocks lie when the visit begins; upright blocks: standBlocks(). Strews the others over the field beside
/// the building's site: drops them by a few millimetres, in groups, large blocks first, with the scene's own dynamics
/// in lockstep, and then lets all of them settle together. At the end every block is at rest with its centre on the
/// field. Results are bit-identical for the same building and seed. `folder`: scratch space. X_WB is empty when
/// `progress` stopped the run. Throws InputError (E974, E977). Thread: main.
Ruins strewRuins(const Building& building, std::uint64_t seed, const std::string& folder,
                 const RuinsProgress& progress);

}  // namespace presa::temple
