#pragma once
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

/// From where a file may name another one. A person names any file; a file names only what lies, symbolic links followed, in
///   the folder of the file that names it, or below,
///   the folder of a file that stands on the command line, or below,
///   Presa's own config and experiments, or
///   a folder given with --allow-folder, or in PRESA_ALLOW_FOLDERS (separated by colons).
/// Thread: main, while nothing else runs, to allow; any to ask.
namespace presa::input {

/// Allows `folder` for this process and those that it starts (by PRESA_ALLOW_FOLDERS).
void allowFolder(const std::string& folder);
/// Allows the folder of each regular file that stands on the command line, alone or after '='.
void allowFoldersOf(int count, char** words);

/// Whether a file in `folder` ("": the working directory) may name `file`.
bool mayName(const std::string& folder, const std::string& file);
/// Asked before a file that another one names is opened. E692 when the file of `where` may not name it; true when it may.
bool checkNamed(const SourceLocation& where, const std::string& file, Diagnostics& diagnostics);
/// E692 in words: what and help.
std::string outside(const std::string& folder, const std::string& file);
inline constexpr int kOutside = 692;
extern const char* const kOutsideHelp;

}  // namespace presa::input
