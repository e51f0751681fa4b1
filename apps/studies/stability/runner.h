#pragma once
#include <string>
#include <vector>

#include "experiments/stability/case.h"

namespace presa::stability {

/// What the command line asks for.
struct RunnerOptions {
  std::vector<std::string> cases;  ///< empty: all
  bool list = false;
  bool quick = false;
  std::string out;  ///< folder; empty: nothing is written
  std::string format = "text";
  int jobs = 0;
};

/// Runs those of `all` that the options choose; returns the exit status. Throws InputError for names and folders that are
/// wrong, before any work.
int runCases(const RunnerOptions& options, std::vector<Case> all = allCases());

}  // namespace presa::stability
