#pragma once
#include <array>
#include <cstdint>
#include <string>

namespace presa::device {

struct PeriodsOptions {
  std::array<std::string, 2> scenes;
  int runs = 100;      ///< per scene
  double seconds = 2;  ///< duration of one run
  std::uint64_t seed = 1;
  std::string out;  ///< folder for periods.json; empty: not written
};

/// `presa device periods`: runs two scenes alternately in real time and compares their haptic periods: medians over the
/// runs of the 50th, 99th and 99.9th percentile, their ratio (second scene over first), and its 95 % bootstrap
/// interval. Results are given for all runs and for the runs without steal time. Returns exit status 0 when compared,
/// 130 after Ctrl-C. Throws InputError: E469 SCHED_FIFO is refused, and the errors of the scenes.
int comparePeriods(const PeriodsOptions& options);

}  // namespace presa::device
