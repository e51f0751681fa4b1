#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// The rows as one self-contained HTML page: the verdict, a grid of cases and methods, then each case with its
/// plots and rows, closed unless a verdict is worse than expected.
std::string reportHtml(const std::vector<Case>& cases, const std::vector<Row>& rows);

}  // namespace presa::stability
