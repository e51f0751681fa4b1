#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// "0.0123 %"; a value that is no number says so.
std::string valueText(double value, const std::string& unit);
/// "2 N/mm, 10 g"
std::string parameterText(const Parameters& parameters);

/// The rows by case, Presa's beside what it replaces, and a closing line. `out` may be empty.
std::string tableText(const std::vector<Case>& cases, const std::vector<Row>& rows, const std::string& out);

}  // namespace presa::stability
