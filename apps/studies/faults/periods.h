#pragma once
#include <array>
#include <cstdint>
#include <string>

namespace presa::device {

struct PeriodsOptions {
  std::array<std::string, 2> scenes;
  int runs = 100;      ///< of each scene
  double seconds = 2;  ///< of one run
  std::uint64_t seed = 1;
  std::string out;  ///< folder for periods.json; empty: none
};

/// `presa device periods`: two scenes against the clock, in turn, and how the second one's haptic period differs: medians over the runs
/// of the 50th, 99th and 99.9th percentile, their ratio, and its 95 % interval by bootstrap. Runs in which another machine took the
/// processor (steal) count apart. Exit status 0 compared, 130 Ctrl-C. Throws InputError: E469 SCHED_FIFO is refused here, and what a
/// scene has.
int comparePeriods(const PeriodsOptions& options);

}  // namespace presa::device
