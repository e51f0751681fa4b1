#pragma once
#include <memory>
#include <string>
#include <vector>

#include "apps/common/options/command_line.h"
#include "apps/studies/cost/plan.h"
#include "apps/studies/cost/result.h"

namespace presa::cost {

/// The command line of a study.
struct Arguments {
  Request request;
  int jobs = 0;
  bool resume = false, instructions = false;
  std::string apply;  ///< scene to write where the default is beaten; empty: none
};

/// Adds the options that say what is studied: SCENE, --knob, --metric, --quick, --rig, --set, --seed, --for,
/// --instructions; and --out, --apply.
void addStudyOptions(Command command, const std::shared_ptr<Arguments>& a);

/// The same as words, with absolute paths; without --out and --apply.
std::vector<std::string> wordsOf(const Arguments& a);
/// As the report shows it.
std::string commandLine(const Arguments& a);

/// E123 without a scene.
void requireScene(const Arguments& a, Diagnostics& diagnostics);

/// Writes report, table and picture, and prints the verdict. Returns the exit status.
int writeResults(const Result& result, const std::string& apply);
/// Says how to go on after Ctrl-C. Returns the exit status.
int interrupted(const std::string& folder, const std::string& command);

}  // namespace presa::cost
