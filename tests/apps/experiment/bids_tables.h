#pragma once
#include "tests/apps/experiment/bids_files.h"

namespace presa::experiment::bids {

/// Violations of the rules for tables and their dictionaries.
std::vector<std::string> tableViolations(const std::string& dataset, const std::vector<File>& files);

/// Violations of one recording: motion file, channels, sidecar.
std::vector<std::string> motionViolations(const File& motion);

}  // namespace presa::experiment::bids
