#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace presa {

/// The description of a session as aligned text, with a column for each measured figure.
std::string explainText(const nlohmann::json& run);
/// The same graph for graphviz.
std::string explainDot(const nlohmann::json& run);

}  // namespace presa
