#pragma once
#include <stdexcept>

#include "framework/core/schedule/rates.h"

namespace presa {

/// Throws std::invalid_argument unless the haptic thread has four samples or more for a period of a sinusoid of that
/// frequency [Hz]: with fewer the hand feels another one. For the constructor of an effect (E596). Thread: main.
inline void requireRendered(double frequency, const Rates& rates) {
  if (4 * frequency > rates.haptic) throw std::invalid_argument("frequency is above a quarter of the haptic rate");
}

}  // namespace presa
