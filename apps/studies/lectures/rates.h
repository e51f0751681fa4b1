#pragma once
#include <string>
#include <vector>

#include "experiments/stability/case.h"

namespace presa::lectures {

/// Haptic rates that the lectures show [Hz].
inline constexpr double kLectureRates[] = {1000, 500, 250, 167};

/// Overrides for a haptic rate, with slower rates that divide it.
inline std::vector<std::string> ratesOf(double haptic) {
  return {"rates/haptic=" + stability::number(haptic), "rates/dynamics=" + stability::number(haptic),
          "rates/collision=" + stability::number(haptic / 2)};
}

}  // namespace presa::lectures
