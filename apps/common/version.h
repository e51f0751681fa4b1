#pragma once
#include <string>

namespace presa {
inline constexpr const char* kVersion = PRESA_VERSION;
/// Commit of the source at the time of the build, with "-dirty" after changes; empty: not known.
extern const char* const kCommit;

/// "0.1.0, commit 98a17900fa3f".
inline std::string versionText(const std::string& version = kVersion) {
  return *kCommit == '\0' ? version : version + ", commit " + kCommit;
}
}  // namespace presa
