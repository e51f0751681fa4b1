#include <algorithm>
#include <iterator>

#include "experiments/faults/fault.h"

namespace presa::faults {
namespace {

constexpr double kSlew = 1000 * 1e-3;  // slew limit of the scene [N] per tick
constexpr double kRounding = 1e-9;

}  // namespace

std::string brokenBy(const Fault& fault, const Outcome& outcome) {
  if (!outcome.broken.empty()) return outcome.broken.front();
  if (outcome.step > kSlew * (1 + kRounding)) return "force step above the slew limit";
  const Bounds& bounds = fault.bounds;
  if (bounds.detection > 0 &&
      (outcome.detection < 0 || outcome.detection > bounds.detection + outcome.held_up_detection))
    return "detected too late";
  if (bounds.zero > 0 && outcome.zero > bounds.zero + outcome.held_up_zero) return "zero too late";
  if (bounds.energy && outcome.energy > outcome.energy_allowed) return "energy given to the hand";
  return {};
}

std::vector<Fault> allFaults() {
  std::vector<Fault> all;
  for (std::vector<Fault> (*family)() :
       {holdFaults, falconFaults, +[] { return processFaults(0); }, sceneFaults, viewerFaults})
    std::ranges::move(family(), std::back_inserter(all));
  std::ranges::stable_sort(all, {}, &Fault::row);
  return all;
}

}  // namespace presa::faults
