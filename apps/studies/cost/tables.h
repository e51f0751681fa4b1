#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// The whole result as JSON.
std::string toJsonText(const Result& result);
/// CSV with one row per setting: factors, errors, costs, failure.
std::string toCsv(const Result& result);
/// CSV with one row per timed run: factors, repeat, costs, the hardware that it ran on.
std::string toRunsCsv(const Result& result);

}  // namespace presa::cost
