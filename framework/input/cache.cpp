#include "framework/input/cache.h"

#include <cstdlib>
#include <filesystem>

namespace presa::input {

std::string cacheFolder(const std::string& name) {
  const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
  if (cache != nullptr && *cache == '/') return (std::filesystem::path(cache) / "presa" / name).string();
  if (home != nullptr && *home == '/') return (std::filesystem::path(home) / ".cache" / "presa" / name).string();
  return {};
}

}  // namespace presa::input
