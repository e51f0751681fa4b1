#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/temple/building/block.h"

namespace presa::temple {

struct Ruins {
  std::vector<Pose> X_WB;        ///< by block
  double simulated_seconds = 0;  ///< of all runs
  double still = 0;              ///< how far the farthest block moved in the last second [m]
};

/// Called after each step with the number of blocks that lie, and of all; false stops.
using RuinsProgress = std::function<bool(std::size_t lying, std::size_t all, const std::string& what)>;

/// Strews the blocks over the field beside their building's site by falls of a few millimetres, in groups, the large ones first, with the
/// scene's own dynamics in lockstep; then lets all of them settle together. Every block lies at rest, its middle on the field, and in no
/// other. The same building and seed give the same bits. `folder`: scratch space of its own.
/// Empty X_WB when `progress` stopped it. Throws InputError (E974, E977). Thread: main.
Ruins strewRuins(const Building& building, std::uint64_t seed, const std::string& folder,
                 const RuinsProgress& progress);

}  // namespace presa::temple
