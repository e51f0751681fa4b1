#pragma once
#include <string>
#include <vector>

namespace presa::faults {

/// A shared object of Presa that this process has loaded, and what it wants from others.
struct ObjectImports {
  std::string name;                  ///< file name
  std::vector<std::string> imports;  ///< symbols that it does not define
};

/// Framework and plug-ins that are loaded now, read from their files.
std::vector<ObjectImports> loadedObjects();

/// Those by which a program learns what a clock on the wall shows. (clock_gettime is not among them: which clock it is asked for no
/// symbol tells; tests/layering looks for the word CLOCK_REALTIME.)
std::vector<std::string> wallClocksAmong(const std::vector<std::string>& symbols);

}  // namespace presa::faults
