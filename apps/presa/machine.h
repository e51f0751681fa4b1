#pragma once
#include <string>
#include <utility>
#include <vector>

namespace presa {

/// What a cost depends on beside the settings: processor, kernel, compiler, versions. For the fine print.
std::vector<std::pair<std::string, std::string>> machineFacts();

}  // namespace presa
