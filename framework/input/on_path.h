#pragma once

namespace presa::input {

/// Whether a folder of PATH has this program. Thread: any.
bool isOnPath(const char* program);

}  // namespace presa::input
