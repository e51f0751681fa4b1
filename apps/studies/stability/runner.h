#pragma once
#include <string>
#include <vector>

#include "experiments/stability/case.h"

namespace presa::stability {

/// Options of the command line.
struct RunnerOptions {
  std::vector<std::string> cases;  ///< empty: all
  bool list = false;
  bool quick = false;
  std::string out;  ///< output folder; empty: none
  std::string format = "text";
  int jobs = 0;
};

/// Runs the cases of `all` that the options select; returns the exit status. Throws InputError for unknown names and
/// bad folders, before any work.
int runCases(const RunnerOptions& options, std::vector<Case> all = allCases());

}  // namespace presa::stability
