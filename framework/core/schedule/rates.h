#pragma once
#include <array>
#include <cstdint>

#include "framework/core/schedule/tick.h"

namespace presa {

/// Rates of a rig's groups, before rounding (RateTable).
struct Rates {
  double haptic = 1000;    ///< [Hz]
  double collision = 100;  ///< [Hz], haptic / collision is a whole number
  double dynamics = 200;   ///< [Hz], haptic / dynamics is a whole number
  double view = 60;        ///< [Hz]
  double bus = 200;        ///< publishing rate of the run's state [Hz]; not settable in a scene
};

/// The rates of a run in whole nanoseconds. Every group's period is a whole number of haptic periods, so
/// that the ticks of all groups fall on the instants of the haptic ticks.
class RateTable {
 public:
  explicit RateTable(const Rates& rates);  ///< rounds: haptic period to ns, others to haptic periods

  std::int64_t periodNs(RateGroup group) const noexcept { return haptic_ns_ * divisor(group); }          ///< > 0 [ns]
  double period(RateGroup group) const noexcept { return static_cast<double>(periodNs(group)) * 1e-9; }  ///< [s]
  double rate(RateGroup group) const noexcept { return 1e9 / static_cast<double>(periodNs(group)); }     ///< [Hz]
  /// Haptic ticks per tick of the group.
  std::int64_t divisor(RateGroup group) const noexcept { return divisors_[static_cast<std::size_t>(group)]; }
  Tick tick(RateGroup group, std::uint64_t index) const noexcept;              ///< `index` from 0; not late
  std::uint64_t ticksWithin(RateGroup group, double duration) const noexcept;  ///< that begin within `duration` [s]

 private:
  std::int64_t haptic_ns_;
  std::array<std::int64_t, kRateGroupCount> divisors_;
};

}  // namespace presa
