#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// Plots of one case: Presa's curve with that of what it replaces, same parameters and metric, those with the greatest
/// contrast first. HTML, empty when the case has no curves.
std::string curvesHtml(const Case& c, const std::vector<Row>& rows);

}  // namespace presa::stability
