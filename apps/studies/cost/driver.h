#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

struct DriverOptions {
  int workers = 0;  ///< of the watched runs, 0: one per processor; timed runs go one at a time
  bool resume = false;
  bool instructions = false;  ///< count them too, with valgrind
};

/// Runs a study (Study::folder must be there), with its progress on stderr. Throws InputError for bad input before any work. Ctrl-C gives an incomplete
/// result that says so; the runs that ended are kept.
Result runStudy(const Study& study, const DriverOptions& options);

/// Whether files can be written there: E803 when not. Makes the folder.
void checkFolder(const std::string& folder, Diagnostics& diagnostics);

}  // namespace presa::cost
