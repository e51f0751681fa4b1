#pragma once
#include <string>

namespace presa {

/// Makes the folder of an output file and tries whether a file can be made there, before a run that would be lost: rights
/// alone do not say, as a file system may be read-only. Returns the system's reason if not; empty: it can.
std::string placeTrouble(const std::string& file);

}  // namespace presa
