#pragma once
#include <algorithm>

#include "framework/scene/scene.h"

/// Maximum age of data from another rate group before it counts as stale [s]. The only definition of these limits.
///
/// A value written every period P is up to P old just before the next write, and up to 2 P old while that write is
/// being computed or when one write is missed. Data older than 2 P means that the writer has stopped. The lower limit
/// of 20 ms allows for the time a thread may wait for a processor. At the usual rates (collision 100 Hz, dynamics 200
/// Hz) every limit is 20 ms.
///     old after = max(20 ms, 2 P)
namespace presa::ages {

inline constexpr double kPeriods = 2;    ///< maximum age in periods of the writer [-]
inline constexpr double kFloor = 0.020;  ///< smallest limit [s]

/// For a writer of that rate [Hz]; [s].
inline double oldAfter(double rate) noexcept { return std::max(kFloor, kPeriods / rate); }

/// Limit for the neighbourhoods, written by the collision thread [s].
inline double neighbourhoods(const Rates& rates) noexcept { return oldAfter(rates.collision); }
/// Limit for the object states, written by the dynamics, for a finger without its own `watchdog_ms` [s].
inline double objects(const Rates& rates) noexcept { return oldAfter(rates.dynamics); }
/// Smallest permitted `watchdog_ms` [s]: a shorter one would fade the force in normal operation.
inline double shortestWatchdog(double dynamics_rate) noexcept { return kPeriods / dynamics_rate; }
/// Limit for the finger states, written by the haptic thread [s]. The dynamics solves a step in substeps, and the last
/// one begins up to one dynamics period after the fingers were read.
inline double fingers(const Rates& rates) noexcept {
  return std::max(kFloor, kPeriods / rates.haptic + 1 / rates.dynamics);
}

}  // namespace presa::ages
