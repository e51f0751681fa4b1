#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// The study as one self-contained HTML page.
std::string reportHtml(const Result& result);

}  // namespace presa::cost
