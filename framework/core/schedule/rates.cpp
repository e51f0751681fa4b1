#include "framework/core/schedule/rates.h"

#include <algorithm>
#include <cmath>

namespace presa {

RateTable::RateTable(const Rates& rates) : haptic_ns_(std::llround(1e9 / rates.haptic)) {
  const auto times = [&](double rate) { return std::max<std::int64_t>(1, std::llround(rates.haptic / rate)); };
  divisors_ = {1, times(rates.collision), times(rates.dynamics), times(rates.view), times(rates.bus)};
}

Tick RateTable::tick(RateGroup group, std::uint64_t index) const noexcept {
  const auto ns = static_cast<std::int64_t>(index) * periodNs(group);
  return {index, static_cast<double>(ns) * 1e-9, period(group), false};
}

std::uint64_t RateTable::ticksWithin(RateGroup group, double duration) const noexcept {
  const auto ns = std::llround(duration * 1e9);
  const auto period_ns = periodNs(group);
  return static_cast<std::uint64_t>(std::max<long long>(0, (ns + period_ns - 1) / period_ns));
}

}  // namespace presa
