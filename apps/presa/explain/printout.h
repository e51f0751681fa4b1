#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace presa {

/// The description of a session for people: aligned, with a column for each figure when it has been measured.
std::string explainText(const nlohmann::json& run);
/// The same graph for graphviz.
std::string explainDot(const nlohmann::json& run);

}  // namespace presa
