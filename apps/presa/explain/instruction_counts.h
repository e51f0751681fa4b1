#pragma once
#include <map>
#include <optional>
#include <string>

#include "apps/presa/explain/callgrind_file.h"
#include "framework/session/load_world.h"

namespace presa {

/// Runs this program again, under valgrind's callgrind, in lockstep without a view for `duration` simulated seconds,
/// `recorded` or not.
/// Nothing when valgrind is not installed. Throws std::runtime_error, with its last lines, when it fails.
/// Deterministic, unlike time: an instruction is counted however long it took. Takes about a hundred times longer.
std::optional<std::map<std::string, FunctionCost>> countInstructions(const Inputs& inputs, double duration,
                                                                     bool recorded = false);

/// Sum over the functions named `function` whatever their arguments, lambdas inside them not again; nothing
/// when there was none.
std::optional<FunctionCost> costOf(const std::map<std::string, FunctionCost>& costs, const std::string& function);

}  // namespace presa
