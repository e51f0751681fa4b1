#pragma once
#include <optional>
#include <string>

#include "tests/layering/source_tree.h"

/// The rules of the architecture, each a function from a file to what is wrong with it (nothing: no value).
namespace presa::layering {

using Finding = std::optional<std::string>;

Finding includesForeignLibrary(const SourceFile& file);
Finding includesAgainstTheArrows(const SourceFile& file);
Finding lacksPragmaOnce(const SourceFile& file);
Finding isTooLong(const SourceFile& file);
Finding namesPathOfOneMachine(const SourceFile& file);
/// What runs goes by the clock that never jumps.
Finding readsTheWallClock(const SourceFile& file);
/// Files from outside come in by framework/input; what is left to the standard library are files of /proc, and the program's own.
Finding opensAFileByItself(const SourceFile& file);

}  // namespace presa::layering
