#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/study.h"
#include "experiments/study/conditions.h"

/// Knobs that are no values of the scene: conditions of the run, written as sets "run/latency=0.01". Nobody chooses
/// them, so a setting with one is compared with the reference, and is never the better setting.
namespace presa::cost {

/// Takes the conditions out of the sets; the others stay. Errors (E801: unknown, E802: out of range) go to
/// `diagnostics`.
Conditions takeConditions(std::vector<std::string>& sets, Diagnostics& diagnostics);

/// E802 for a condition among the sets of all settings; it is taken out.
void refuseConditions(std::vector<std::string>& sets, const SourceLocation& where, Diagnostics& diagnostics);

/// Whether the setting runs under other conditions than the scene alone.
bool hasConditions(const Setting& setting);

/// Every value, for a hash.
std::string toText(const Conditions& conditions);

}  // namespace presa::cost
