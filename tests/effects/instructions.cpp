#include "tests/effects/instructions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/apps/support/support.h"

namespace presa::test {
namespace {

// Replaces "{ticks}", and "{seconds}" for the program's --for.
std::string withLength(std::string command, int ticks) {
  const auto replace = [&](const std::string& key, const std::string& value) {
    if (const std::size_t at = command.find(key); at != std::string::npos) command.replace(at, key.size(), value);
  };
  replace("{ticks}", std::to_string(ticks));
  replace("{seconds}", std::to_string(ticks * 1e-3));
  return command;
}

double totalInstructions(const std::string& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("totals: ")) return std::stod(line.substr(8));
  }
  ADD_FAILURE() << "no total in " << file;
  return 0;
}

double count(const std::string& command, int ticks, std::string& out) {
  const std::string file = scratch("callgrind.out");
  const Outcome outcome =
      // count inside the tick only: start-up varies from run to run with addresses and process numbers
      shell("valgrind --tool=callgrind --toggle-collect='presa::Graph::step(*' --callgrind-out-file=" + file + ' ' +
            withLength(command, ticks));
  EXPECT_EQ(outcome.status, 0) << command << '\n' << outcome.out << outcome.err;
  out = outcome.out;
  return outcome.status == 0 ? totalInstructions(file) : 0;
}

}  // namespace

bool valgrindWorks() { return shell("valgrind --version").status == 0; }

TickCount countPerTick(const std::string& command, int short_ticks, int long_ticks) {
  TickCount result;
  const double less = count(command, short_ticks, result.out);
  const double more = count(command, long_ticks, result.out);
  result.instructions = (more - less) / (long_ticks - short_ticks);
  return result;
}

}  // namespace presa::test
