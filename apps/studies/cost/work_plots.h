#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// Work–precision plots (error over processor time) of the judged metrics, at most four.
std::string workPlots(const Result& result);
/// The same of the other metrics, without those that show no more than a plot before them.
std::string otherPlots(const Result& result);
/// The plot of the first judged metric as an SVG file, or "".
std::string frontPicture(const Result& result);

/// Whether a level is so close to points between `low` and `high` that drawing it does not squeeze them.
bool isNear(double level, double low, double high);

}  // namespace presa::cost
