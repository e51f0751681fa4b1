#pragma once
#include <optional>
#include <string>

#include "tests/layering/source_tree.h"

/// The rules of the architecture, each a function from a file to its finding (no value: the file obeys the rule).
namespace presa::layering {

using Finding = std::optional<std::string>;

Finding includesForeignLibrary(const SourceFile& file);
Finding includesAgainstTheArrows(const SourceFile& file);
Finding lacksPragmaOnce(const SourceFile& file);
Finding isTooLong(const SourceFile& file);
Finding namesPathOfOneMachine(const SourceFile& file);
/// framework, modules and devices must use the monotonic clock.
Finding readsTheWallClock(const SourceFile& file);
/// Files from outside must be opened by framework/input; exceptions are files of /proc and the program's own.
Finding opensAFileByItself(const SourceFile& file);

}  // namespace presa::layering
