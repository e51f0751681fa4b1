#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/support/support.h"

namespace presa::test {

/// A study of four settings that takes a second.
inline const std::string kStudy = "cost " + source("config/scenes/cube.xml") +
                                  " --quick --for 1.2 --knob dynamics_rate=100,200 --knob coupling=soft,explicit";

/// All that does not depend on the time that runs took.
inline nlohmann::json accuracyOf(const nlohmann::json& result) {
  nlohmann::json all{{"reference", result.at("reference")}};
  for (const nlohmann::json& setting : result.at("settings"))
    all["settings"].push_back({setting.at("name"), setting.at("knobs"), setting.at("set"), setting.at("error"),
                               setting.at("below_resolution"), setting.at("failure")});
  for (const nlohmann::json& metric : result.at("metrics"))
    all["metrics"].push_back({metric.at("name"), metric.value("resolution", 0.0)});
  return all;
}

}  // namespace presa::test
