#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// Value and unit, such as "0.0123 %"; also for values that are not finite.
std::string valueText(double value, const std::string& unit);
/// The parameters as text, such as "2 N/mm, 10 g".
std::string parameterText(const Parameters& parameters);

/// Text table of the rows by case, Presa's method beside the baselines, with a closing line. `out`: output folder, may
/// be empty.
std::string tableText(const std::vector<Case>& cases, const std::vector<Row>& rows, const std::string& out);

}  // namespace presa::stability
