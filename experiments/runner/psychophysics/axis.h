#pragma once
#include <cmath>

namespace presa::psychophysics {

enum class Unit { kLinear, kLnRatio, kDecibel };

/// What a level means in the scene: methods step on the level, the scene takes the value. Equal steps are equal ratios
/// on the last two (PsychoPy's stepType log and db with standard 1; there log has base 10, here e).
struct Axis {
  Unit unit = Unit::kLinear;
  double standard = 0;  ///< value at level 0; > 0 unless linear

  double valueAt(double level) const {
    switch (unit) {
      case Unit::kLinear:
        return standard + level;
      case Unit::kLnRatio:
        return standard * std::exp(level);
      case Unit::kDecibel:
        return standard * std::pow(10, level / 20);  // of an amplitude
    }
    return standard;
  }
  /// value / standard > 0 unless linear.
  double levelAt(double value) const {
    switch (unit) {
      case Unit::kLinear:
        return value - standard;
      case Unit::kLnRatio:
        return std::log(value / standard);
      case Unit::kDecibel:
        return 20 * std::log10(value / standard);
    }
    return 0;
  }
};

}  // namespace presa::psychophysics
