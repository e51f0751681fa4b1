#pragma once
#include <cmath>

namespace presa::psychophysics {

/// Of a level: that of the value; the natural logarithm of value / standard; 20 log10(value / standard) [dB].
enum class Unit { kLinear, kLnRatio, kDecibel };

/// Converts between the level, on which a method steps, and the value that the scene takes. On the last two units equal
/// steps are equal ratios (PsychoPy's stepType log and db with standard 1; its log has base 10, ours base e).
struct Axis {
  Unit unit = Unit::kLinear;  ///< of levels
  double standard = 0;        ///< value at level 0; > 0 unless linear

  /// Value of a level; the inverse of levelAt.
  double valueAt(double level) const {
    switch (unit) {
      case Unit::kLinear:
        return standard + level;
      case Unit::kLnRatio:
        return standard * std::exp(level);
      case Unit::kDecibel:
        return standard * std::pow(10, level / 20);  // dB of an amplitude
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
