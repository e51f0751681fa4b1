#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

struct DriverOptions {
  int workers = 0;  ///< parallel watched runs, 0: one per processor; timed runs run one at a time
  bool resume = false;
  bool instructions = false;  ///< count instructions too, with valgrind
};

/// Runs a study with progress on stderr. Study::folder must exist. Throws InputError for bad input before any work.
/// After Ctrl-C the result is incomplete and marked as interrupted; finished runs are kept on disk.
Result runStudy(const Study& study, const DriverOptions& options);

/// Creates the folder and checks that it is writable: otherwise E803.
void checkFolder(const std::string& folder, Diagnostics& diagnostics);

}  // namespace presa::cost
