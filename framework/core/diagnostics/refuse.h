#pragma once
#include <string>
#include <utility>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa {

/// Throws InputError with one finding about a whole file or an option; `file` may be empty.
[[noreturn]] inline void refuse(int code, const std::string& file, const std::string& message,
                                const std::string& help = {}) {
  Diagnostics diagnostics;
  diagnostics.error(code, {file, 0, 0}, message, help);
  throw InputError(std::move(diagnostics));
}

}  // namespace presa
