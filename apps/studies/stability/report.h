#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// The rows as one self-contained HTML page: a matrix of verdicts, then a table and curves for each case.
std::string reportHtml(const std::vector<Case>& cases, const std::vector<Row>& rows);

}  // namespace presa::stability
