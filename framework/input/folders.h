#pragma once
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

/// Rules on the files that a file may name. The user may name any file; a file may name only files that, after
/// resolving symbolic links, lie in or below
///   the folder of the file that names it,
///   the folder of a file on the command line,
///   Presa's own config and experiments, or
///   a folder given with --allow-folder or in PRESA_ALLOW_FOLDERS (separated by colons).
/// Thread: allowFolder and allowFoldersOf: main, before other threads start; the queries: any.
namespace presa::input {

/// Presa's own folder of that name, "config" or "experiments", above the program or installed with it. Empty: there is
/// none.
std::string ownFolder(const std::string& name);

/// Allows `folder` for this process and its child processes (through PRESA_ALLOW_FOLDERS).
void allowFolder(const std::string& folder);
/// Allows the folder of each regular file on the command line, given alone or after '='.
void allowFoldersOf(int count, char** words);

/// Whether a file in `folder` ("": the working directory) may name `file`.
bool mayName(const std::string& folder, const std::string& file);
/// Call before opening a file that another one names. Reports E692 and returns false when it is not allowed.
bool checkNamed(const SourceLocation& where, const std::string& file, Diagnostics& diagnostics);
/// Message of E692.
std::string outside(const std::string& folder, const std::string& file);
enum FolderCode { kOutside = 692 };
extern const char* const kOutsideHelp;

}  // namespace presa::input
