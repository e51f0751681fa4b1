#pragma once
#include <string>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// Checks before any run that `file` can be written and is not the scene itself: otherwise E809.
void checkApply(const std::string& file, const Study& study, Diagnostics& diagnostics);

/// Where the default is beaten (verdict.h): writes the scene with the better setting's values, and those of --set, to
/// `file`. Elsewhere writes nothing. Returns the sentence that says which. Throws InputError, std::system_error.
std::string applyBetter(const Result& result, const std::string& file);

}  // namespace presa::cost
