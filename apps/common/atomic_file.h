#pragma once
#include <string>

namespace presa {

/// Whether the path is a device, a pipe, or an open file of this process such as /dev/stdout: it is written to, since a
/// rename would replace it.
bool isStream(const std::string& path);

/// Writes `text` to a hidden file beside `path` and renames it: a reader sees the old file or the whole new one.
/// A stream is written to. Throws std::system_error with the path on failure, and leaves no file behind.
void writeFileAtomically(const std::string& path, const std::string& text);

/// Removes the hidden files that writeFileAtomically left in a folder when its process died before the rename.
void removeHalfWritten(const std::string& folder);

}  // namespace presa
