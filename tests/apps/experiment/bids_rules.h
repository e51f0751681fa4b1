#pragma once
#include <string>
#include <vector>

/// What the Brain Imaging Data Structure asks of a raw dataset with behaviour and motion, written down from the specification
/// (version 1.10 and the rules in its src/schema), not from the exporter: each rule names its place there.
namespace presa::experiment::bids {

/// Every violation below a dataset's folder, "path: rule: what".
std::vector<std::string> violations(const std::string& dataset);

}  // namespace presa::experiment::bids
