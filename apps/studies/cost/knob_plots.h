#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// HTML: error over each knob of numbers with three values or more, all other knobs as in the scene; in the first error
/// that the study judges. Empty: there is no such knob.
std::string knobPlots(const Result& result);

}  // namespace presa::cost
