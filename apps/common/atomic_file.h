#pragma once
#include <string>

namespace presa {

/// Writes `text` to a hidden file beside `path` and renames it: a reader sees the old file or the whole new one.
/// A device or a pipe, such as /dev/stdout, is written to. Throws std::system_error with the path on failure, and leaves no file behind.
void writeFileAtomically(const std::string& path, const std::string& text);

/// Removes the hidden files that writeFileAtomically left in a folder when its process died before the rename.
void removeHalfWritten(const std::string& folder);

}  // namespace presa
