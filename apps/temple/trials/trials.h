#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/cluster/shard.h"

namespace presa::temple {

/// Ruins of consecutive seeds, each rebuilt by the simulated hands.
struct TrialsPlan {
  std::string size = "column", plan = "vitruvius";  ///< as of presa temple
  int seeds = 20;
  std::uint64_t first_seed = 1;
  double limit = 0;  ///< simulated time of a trial [s]; 0: that of presa temple --auto
  int jobs = 0;      ///< trials at a time; 0: one per processor
  std::string out;
  std::optional<cluster::Shard> shard{};  ///< none: all seeds
};

/// One trial.
struct Trial {
  std::uint64_t seed = 0;
  std::string reason;  ///< it gave no result: why; else empty
  int pieces = 0, placed = 0, drops = 0, lost = 0;
  std::uint32_t faults = 0;   ///< ObjectFault bits
  double position_error = 0;  ///< of the worst placed block [m]
  double angle_error = 0;     ///< likewise [deg]
  double simulated = 0;       ///< [s]
  double wall = 0;            ///< [s]

  bool whole() const { return reason.empty() && placed == pieces && lost == 0 && faults == 0; }
};

/// Makes it where it is missing; throws InputError E815.
void makeFolder(const std::string& folder);

/// The words after `presa` that repeat one trial.
std::vector<std::string> wordsOf(const TrialsPlan& plan, std::uint64_t seed);

struct Trials {
  std::vector<Trial> all;  ///< by rising seed
  bool interrupted = false;
};
/// Runs the seeds of the shard, or all, with progress on stderr. The folder gets the output of each trial. Throws
/// std::runtime_error where a trial of a shard was killed from outside: the shard is not finished.
Trials runTrials(const TrialsPlan& plan);

}  // namespace presa::temple
