#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// A section of the report: plots of error over cost, a pair for every metric.
std::string workPlots(const Result& result);

/// The plot for the metric of the study's first sentence, as the text of an SVG file; empty: none.
std::string frontPicture(const Result& result);

}  // namespace presa::cost
