#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// The whole result for programs.
std::string toJsonText(const Result& result);
/// One row per setting: knobs, errors, costs, failure.
std::string toCsv(const Result& result);

}  // namespace presa::cost
