#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// Error over cost, a pair of plots for every metric, as a section of the page.
std::string workPlots(const Result& result);

/// The plot of the metric that the study's first sentence is about, as an SVG file; empty: there is none.
std::string frontPicture(const Result& result);

}  // namespace presa::cost
