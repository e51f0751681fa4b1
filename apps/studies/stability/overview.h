#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// Grid of verdicts as HTML: a line for each case that has rows, a column for each family of methods that has some.
/// A cell has the sign of its worst verdict and the count of its stable findings, and each line leads to the element
/// whose id is the case's name.
std::string overviewHtml(const std::vector<Case>& cases, const std::vector<Row>& rows);

}  // namespace presa::stability
