#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// Plots of one case as HTML: Presa's curve with that of the baseline method for the same parameters and metric,
/// ordered by falling contrast of the verdicts. Empty when the case has no curves.
std::string curvesHtml(const Case& c, const std::vector<Row>& rows);

}  // namespace presa::stability
