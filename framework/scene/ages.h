#pragma once
#include <algorithm>

#include "framework/scene/scene.h"

/// When what another rate group wrote counts as old. The one place that says so.
///
/// A value that is written every period P is up to P old just before the next one comes, and up to P more while the next
/// one is being worked out, or where one is missed. Older than 2 P, its writer has stopped. A writer that is fast is given
/// 20 ms all the same: its thread may have to wait that long for a processor. At the usual rates (collision 100 Hz,
/// dynamics 200 Hz) each age is 20 ms.
///     old after = max(20 ms, 2 P)
namespace presa::ages {

inline constexpr double kPeriods = 2;    ///< of the writer
inline constexpr double kFloor = 0.020;  ///< [s]

inline double oldAfter(double rate) noexcept { return std::max(kFloor, kPeriods / rate); }

/// Of the contact patches, which the collision thread writes [s].
inline double patches(const Rates& rates) noexcept { return oldAfter(rates.collision); }
/// Of the Object State, which the dynamics writes, for a finger whose `watchdog_ms` says nothing else [s].
inline double objects(const Rates& rates) noexcept { return oldAfter(rates.dynamics); }
/// A shorter `watchdog_ms` than this lets forces fade while all is well [s].
inline double shortestWatchdog(double dynamics_rate) noexcept { return kPeriods / dynamics_rate; }
/// Of the fingers, which the haptic thread writes. The dynamics solves a step in parts, of which the last begins up to a
/// period of its own after the fingers were read [s].
inline double fingers(const Rates& rates) noexcept {
  return std::max(kFloor, kPeriods / rates.haptic + 1 / rates.dynamics);
}

}  // namespace presa::ages
