#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/studies/cost/plan.h"
#include "apps/studies/cost/result.h"

namespace presa::cost {

struct DriverOptions {
  int workers = 0;  ///< parallel watched runs, 0: one per processor; timed runs run one at a time
  bool resume = false;
  bool instructions = false;  ///< count instructions too, with valgrind
  /// Where the costs in the study's folder were measured, to which none is added; empty: they are measured on this
  /// machine.
  std::vector<std::pair<std::string, std::string>> measured_on{};
};

/// Runs a study with progress on stderr. Study::folder must exist. Throws InputError for bad input before any work.
/// After Ctrl-C the result is incomplete and marked as interrupted; finished runs are kept on disk.
Result runStudy(const Study& study, const DriverOptions& options);
/// Makes the runs of one shard, and keeps them in Study::folder for the merge. Costs are measured while no other shard
/// of the user runs on this machine. False: interrupted. Throws as runStudy, and std::runtime_error where runs were killed
/// from outside: their shard is not finished.
bool runShard(const Study& study, const Shard& shard, const DriverOptions& options);

/// Creates the study's folder and checks that it is writable and has room for the runs: otherwise E803.
void checkFolder(const Study& study, Diagnostics& diagnostics);

}  // namespace presa::cost
