#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// The study as one HTML page that stands alone.
std::string reportHtml(const Result& result);

}  // namespace presa::cost
