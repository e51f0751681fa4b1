#pragma once
#include <string>
#include <vector>

namespace presa::faults {

/// A shared object of Presa loaded by this process, with its imported symbols.
struct ObjectImports {
  std::string name;                  ///< file name
  std::vector<std::string> imports;  ///< undefined symbols
};

/// The loaded framework library and plug-ins, read from their files.
std::vector<ObjectImports> loadedObjects();

/// The symbols that read the wall clock. clock_gettime is not among them, because the symbol does not show which clock
/// is read; tests/layering searches for CLOCK_REALTIME instead.
std::vector<std::string> wallClocksAmong(const std::vector<std::string>& symbols);

}  // namespace presa::faults
