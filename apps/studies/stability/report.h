#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// The rows as one self-contained page: a matrix of verdicts, and for each case its table and curves.
std::string reportHtml(const std::vector<Case>& cases, const std::vector<Row>& rows);

}  // namespace presa::stability
