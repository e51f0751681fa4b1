#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/printed_figures.h"
#include "apps/common/run_result.h"

namespace presa::html {

/// A heading, and the summary of the run below it.
using SummaryColumn = std::pair<std::string, nlohmann::json>;

/// The printed figures that runs show, beside those of each run; below it what to know about them, and where the
/// print is wrong.
std::string printedTable(const Printed& printed, const std::vector<SummaryColumn>& runs);

/// The same for one run as a section. Empty for a scene without a file of printed figures; the findings where that file
/// is in error.
std::string printedSection(const RunResult& result);

}  // namespace presa::html
