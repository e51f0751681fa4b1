#pragma once
#include <string>

namespace presa::test {

bool valgrindWorks();

/// Cost of a haptic tick from two runs of one program with different lengths.
struct TickCount {
  double instructions = 0;  ///< per tick, from the difference of the two runs: start-up cancels
  std::string out;          ///< standard output of the longer run
};
/// Counts the instructions of `command`, in which "{ticks}" stands for the length in haptic ticks. Fails the test when
/// the command does not run.
TickCount countPerTick(const std::string& command, int short_ticks = 500, int long_ticks = 2500);

}  // namespace presa::test
