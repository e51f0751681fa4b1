#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/faults/fault.h"

namespace presa::faults {

struct RunnerOptions {
  int runs = 1000;  ///< of each fault
  std::uint64_t seed = 1;
  std::string only;  ///< part of a fault's name; empty: all
  std::string out;   ///< folder; empty: nothing is written
  int jobs = 0;      ///< processes at a time; 0: as many as there are processors
};

/// The worst of all runs of one fault.
struct Row {
  Fault fault;
  int runs = 0;
  Outcome worst;             ///< largest of each; `broken` holds the first few reasons
  double energy_beyond = 0;  ///< most given to the hand beyond what sampling may add [J]
  int broken = 0;            ///< runs that broke a bound or a requirement
  std::string reason;        ///< of the first
  std::vector<std::string>
      discarded;        ///< runs of which nobody could tell when the fault came: why, each with its figure
  bool watched = true;  ///< no force of any run broke one of the four invariants (device/transport_watch.h)
};

/// Runs them in processes of their own; returns the exit status. Throws InputError.
int runFaults(const RunnerOptions& options);

nlohmann::ordered_json toJson(const std::vector<Row>& rows);
std::string tableText(const std::vector<Row>& rows);
std::string pageHtml(const std::vector<Row>& rows, const RunnerOptions& options);

}  // namespace presa::faults
