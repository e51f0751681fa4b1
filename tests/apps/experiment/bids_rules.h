#pragma once
#include <string>
#include <vector>

/// Rules of the Brain Imaging Data Structure for a raw dataset with behaviour and motion. They are written from the
/// specification (version 1.10 and the rules in its src/schema), independently of the exporter; each rule cites its
/// place.
namespace presa::experiment::bids {

/// Every violation below a dataset's folder, as "path: rule: what".
std::vector<std::string> violations(const std::string& dataset);

}  // namespace presa::experiment::bids
