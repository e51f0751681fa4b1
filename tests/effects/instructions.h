#pragma once
#include <string>

namespace presa::test {

bool valgrindWorks();

/// What two runs of one program, of different length, say about a haptic tick.
struct TickCount {
  double instructions = 0;  ///< per tick, by the difference of the two: start-up cancels
  std::string out;          ///< standard output of the longer run
};
/// `command` with "{ticks}" in it where the length goes; lengths in haptic ticks. Fails the test when it does not run.
TickCount countPerTick(const std::string& command, int short_ticks = 500, int long_ticks = 2500);

}  // namespace presa::test
