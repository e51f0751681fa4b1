#pragma once
#include <string>

namespace presa {

/// Writes `text` beside `path` and renames it into place: a reader sees the old file or the whole new one.
/// Throws std::system_error with the path when that fails; nothing is left behind then.
void writeFileAtomically(const std::string& path, const std::string& text);

/// Removes what writeFileAtomically left in a folder when its process died half-way: hidden files under a name of its own.
void removeHalfWritten(const std::string& folder);

}  // namespace presa
