#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace presa::check {

/// What `presa experiment check` finds about a file, as findingsJson() writes it. In the format "text" that program
/// prints its findings to stderr. Throws std::runtime_error when it does not answer.
nlohmann::json askExperiment(const std::string& file, const std::string& rig, const std::string& format);

}  // namespace presa::check
