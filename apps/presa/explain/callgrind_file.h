#pragma once
#include <cstdint>
#include <istream>
#include <map>
#include <string>

namespace presa {

/// What callgrind counted for one function, over a whole run.
struct FunctionCost {
  std::uint64_t calls = 0;
  std::uint64_t instructions = 0;  ///< inclusive: with everything it called
};

/// Reads callgrind's output format 1 (events: Ir first) and sums by function name as the file spells it, with argument
/// types. A function that calls itself is counted at every level.
/// Throws std::runtime_error when the text is not such a file.
std::map<std::string, FunctionCost> readCallgrind(std::istream& in);

}  // namespace presa
