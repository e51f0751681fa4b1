#pragma once
#include <string>

namespace presa::input {

/// Folder in the user's cache for results that took long: $XDG_CACHE_HOME/presa/NAME, or ~/.cache/presa/NAME; "" when the
/// user has none. It need not exist. Deleting it costs time only. Thread: any.
std::string cacheFolder(const std::string& name);

}  // namespace presa::input
