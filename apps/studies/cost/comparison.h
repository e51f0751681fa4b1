#pragma once
#include <algorithm>
#include <functional>
#include <optional>

#include "apps/studies/cost/trace.h"

/// Two runs beside each other, instant by instant: what error metrics are made of.
namespace presa::cost {

using Value = std::optional<double>;

/// Accumulates RMS and maximum.
struct Sum {
  double squares = 0, largest = 0;
  std::size_t count = 0;
  void add(double x) {
    addSquare(x * x);
    largest = std::max(largest, x);
  }
  void addSquare(double square) {  ///< peak() does not know it
    squares += square;
    ++count;
  }
  Value rms() const;
  Value peak() const;
};

/// Calls `use` with the rows of both traces at each common instant inside the setting's compared window.
void atCommonTimes(const Evidence& setting, const Evidence& reference,
                   const std::function<void(std::size_t, std::size_t)>& use);

/// Error of a finger at one instant; no value where it does not count.
using FingerError = std::function<Value(const FingerSample& setting, const FingerSample& reference)>;

/// The largest value over the fingers of `result` of `error`.
Value worstFinger(const Evidence& setting, const Evidence& reference, const FingerError& error,
                  Value (Sum::*result)() const);

}  // namespace presa::cost
