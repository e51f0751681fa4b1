#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// The rows of one case as an HTML table: a group for each metric, whose line names the metric, its reference and its
/// bound where all rows share them; below it a line for each parameter set, with a column for each method.
std::string caseTableHtml(const Case& c, const std::vector<Row>& rows);

}  // namespace presa::stability
