#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// The power p of errors that are proportional to step^p - compared_with^p: those of a method of order p against its own
/// result with the step `compared_with` (0: against the exact result). Steps below three times the latter do not
/// count: two results that are both wrong, each in its own way, differ by more. No value for fewer than two errors above
/// rounding, and where no power between 0.1 and 8 fits them to a factor of 1.5 in the mean.
std::optional<double> fittedOrder(const std::vector<double>& steps, const std::vector<double>& errors,
                                  double compared_with);

/// The orders of all factors with a direction of accuracy, in all metrics that are errors against a reference. Each
/// setting is compared with the finest one of the same values of all other factors, so that only the error of this factor
/// counts; among several such lines the longest one is taken, then that with the default. `evidence`: of a setting, by
/// the hash of its scene.
std::vector<Order> ordersOf(const Result& result, const std::function<Evidence(std::uint64_t)>& evidence);

}  // namespace presa::cost
