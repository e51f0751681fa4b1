#pragma once
#include <string>
#include <utility>
#include <vector>

namespace presa {

/// The platform of a cost measurement: processor, kernel, compiler, versions. For the fine print.
std::vector<std::pair<std::string, std::string>> machineFacts();

/// The facts on which the cost of a run depends, in one line: all but the load.
std::string hardwareText();

/// The wall clock, "2026-03-01T09:30:00Z". For display only: the wall clock may jump, so nothing is computed from it.
std::string utcNow();
/// The same in the zone of the machine: "2026-03-01 10:30:00 +0100".
std::string localNow();
/// Processor, cores and kernel: "… , 4 cores, Linux 6.1.0 x86_64".
std::string machineLine();

}  // namespace presa
