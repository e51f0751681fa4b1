#pragma once
#include "framework/sound/strike.h"

namespace presa::temple {

/// One stone that hits another, or the ground.
struct Hit {
  double time = 0;    ///< of the visit [s]
  double speed = 0;   ///< that the stone lost [m/s]
  double length = 0;  ///< of the stone at the size of the building: cube root of its volume [m]
};

inline constexpr double kSpeedOfSound = 4000;  ///< in marble, 3800 to 6000 by its grain and damp [m/s]
inline constexpr double kStoneDecay = 0.030;   ///< of the lowest sinusoid to 1/e [s]

/// The sound of a block of marble: the lowest frequency is c/2L as of a bar that is free at both ends, with the speed of
/// sound c in marble; louder with the speed, up to 1 m/s.
inline sound::Strike strikeOf(const Hit& hit) {
  return {.time = hit.time,
          .frequency = kSpeedOfSound / (2 * hit.length),
          .decay = kStoneDecay,
          .loudness = hit.speed < 1 ? hit.speed : 1};
}

}  // namespace presa::temple
