#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "framework/device/device.h"

namespace presa::experiment {

/// The value of the fact of this name, NaN where there is none.
inline double factOf(const std::vector<DeviceFact>& facts, const std::string& name) {
  for (const DeviceFact& fact : facts) {
    if (fact.name == name) return fact.value;
  }
  return NAN;
}

}  // namespace presa::experiment
