#pragma once
#include <string>

#include "framework/session/load_world.h"

namespace presa::temple::test {

/// The first task of a visitor with a mouse: scene files are written into `folder`. `language`: of its words.
Loaded loadFirstTask(std::uint64_t seed, const std::string& folder, const RunOptions& options,
                     const std::string& language = "en");

}  // namespace presa::temple::test
