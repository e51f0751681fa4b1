#pragma once
#include <string>

#include "apps/experiment/journal.h"

namespace presa::experiment {

inline constexpr const char* kNothing = "n/a";  ///< a cell without a value

/// JSON as a file.
inline std::string text(const Json& json) { return json.dump(2) + "\n"; }

}  // namespace presa::experiment
