#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "apps/studies/cost/study.h"

namespace presa::cost {

/// Levels of the reference that are run before their errors are known.
inline constexpr std::size_t kFirstLevels = 2;

/// What determines the runs of a study, wherever they are made.
struct Identity {
  std::string rig;                    ///< text of the rig with the same damping in all runs; empty: the study's own rig
  std::vector<std::uint64_t> levels;  ///< hash of the scene at each level of the reference
  std::uint64_t common = 0;  ///< of what all runs share: rig, motions, duration, windows, version with its commit
  std::uint64_t study = 0;   ///< of all of it: with settings, levels, repeats and metrics
};

/// Throws InputError when the study's scene cannot be read.
Identity identityOf(const Study& study);

}  // namespace presa::cost
