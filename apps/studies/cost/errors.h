#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/studies/cost/comparison.h"
#include "apps/studies/cost/metric.h"
#include "apps/studies/cost/run_store.h"

namespace presa::cost {

/// A stored run beside the reference.
struct Compared {
  std::string failure;        ///< why the run cannot be compared; empty: it can
  std::vector<Value> errors;  ///< one per metric; empty after a failure
};

/// From now on the process keeps the pages of a trace for the next one, until malloc_trim().
void keepFreeMemory();

/// Compares the stored runs with `reference`, several at a time in processes of their own: traces have megabytes.
/// `take` is called on this thread once for each run, in any order; false ends the comparison.
/// False: ended by `take` or by Ctrl-C. Throws std::runtime_error when a stored run cannot be read.
bool compareRuns(const RunStore& store, const std::vector<std::uint64_t>& scene_hashes,
                 const std::vector<const Metric*>& metrics, const Evidence& reference, int workers,
                 const std::function<bool(std::size_t run, const Compared& compared)>& take);

}  // namespace presa::cost
