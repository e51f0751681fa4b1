#include "apps/studies/cost/comparison.h"

#include <algorithm>
#include <cmath>

namespace presa::cost {

Value Sum::rms() const { return count > 0 ? Value(std::sqrt(squares / static_cast<double>(count))) : std::nullopt; }
Value Sum::peak() const { return count > 0 ? Value(largest) : std::nullopt; }

void atCommonTimes(const Evidence& setting, const Evidence& reference,
                   const std::function<void(std::size_t, std::size_t)>& use) {
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

Value worstFinger(const Evidence& setting, const Evidence& reference, const FingerError& error,
                  Value (Sum::*result)() const) {
  const std::size_t n = setting.trace.fingers;
  if (n != reference.trace.fingers) return std::nullopt;
  std::vector<Sum> sums(n);
  atCommonTimes(setting, reference, [&](std::size_t i, std::size_t j) {
    for (std::size_t f = 0; f < n; ++f) {
      if (const Value v = error(setting.trace.finger[i * n + f], reference.trace.finger[j * n + f])) sums[f].add(*v);
    }
  });
  Value worst;
  for (const Sum& sum : sums) {
    if (const Value v = (sum.*result)()) worst = std::max(worst.value_or(0), *v);
  }
  return worst;
}

}  // namespace presa::cost
