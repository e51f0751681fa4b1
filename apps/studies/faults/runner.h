#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/faults/fault.h"

namespace presa::faults {

struct RunnerOptions {
  int runs = 1000;  ///< per fault
  std::uint64_t seed = 1;
  std::string only;  ///< substring of fault names; empty: all
  std::string out;   ///< output folder; empty: none
  int jobs = 0;      ///< parallel processes; 0: one per processor
};

/// The worst figures over all runs of one fault.
struct Row {
  Fault fault;
  int runs = 0;
  Outcome worst;                         ///< largest value of each figure
  double energy_beyond = 0;              ///< max energy given to the hand beyond the allowance for sampling [J]
  int broken = 0;                        ///< runs that violated a bound or a requirement
  std::string reason;                    ///< reason of the first such run
  std::vector<std::string> delayed;      ///< runs beyond a bound by no more than the machine held them up, with figures
  std::vector<std::string> not_started;  ///< attempts in which the program never pressed, with the reasons
  bool watched = true;                   ///< no run violated one of the four invariants (device/transport_watch.h)
};

/// Runs the faults in separate processes and returns the exit status. Throws InputError.
int runFaults(const RunnerOptions& options);

nlohmann::ordered_json toJson(const std::vector<Row>& rows);
std::string tableText(const std::vector<Row>& rows);
std::string pageHtml(const std::vector<Row>& rows, const RunnerOptions& options);

}  // namespace presa::faults
