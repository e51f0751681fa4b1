#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "apps/studies/cost/trace.h"

/// Two runs beside each other, instant by instant: what error metrics are made of.
namespace presa::cost {

using Value = std::optional<double>;

/// Accumulates RMS and maximum.
struct Sum {
  double squares = 0, largest = 0;
  std::size_t count = 0;
  void add(double x) {
    squares += x * x;
    largest = std::max(largest, x);
    ++count;
  }
  Value rms() const;
  Value peak() const;
};

/// The largest value of `result`; none where no sum has one.
Value worstOf(const std::vector<Sum>& sums, Value (Sum::*result)() const);

/// Calls `use` with the rows of both traces at each common instant inside the setting's compared window. Templates: a
/// study asks for millions of instants.
template <class Use>
void atCommonTimes(const Evidence& setting, const Evidence& reference, const Use& use) {
  const auto& a = setting.trace.time_ns;
  const auto& b = reference.trace.time_ns;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] < b[j]) {
      ++i;
    } else if (b[j] < a[i]) {
      ++j;
    } else {
      const double time = static_cast<double>(a[i]) * 1e-9;
      if (time >= setting.compared_from && time < setting.compared_to) use(i, j);
      ++i, ++j;
    }
  }
}

/// The largest value over the fingers of `result` of `error`, which has no value at an instant that does not count.
template <class Error>  // Value(const FingerSample& setting, const FingerSample& reference)
Value worstFinger(const Evidence& setting, const Evidence& reference, const Error& error,
                  Value (Sum::*result)() const) {
  const std::size_t n = setting.trace.fingers;
  if (n != reference.trace.fingers) return std::nullopt;
  std::vector<Sum> sums(n);
  atCommonTimes(setting, reference, [&](std::size_t i, std::size_t j) {
    for (std::size_t f = 0; f < n; ++f) {
      if (const Value v = error(setting.trace.finger[i * n + f], reference.trace.finger[j * n + f])) sums[f].add(*v);
    }
  });
  return worstOf(sums, result);
}

}  // namespace presa::cost
