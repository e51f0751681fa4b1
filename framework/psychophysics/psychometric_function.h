#pragma once
#include <cmath>
#include <numbers>

namespace presa::psychophysics {

/// Standard normal distribution function.
inline double normalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Whether the Gaussian lies over the level or over its logarithm (levels > 0).
enum class Scale { kLinear, kLn };

/// Probability of a positive answer: guess + (1 - guess - lapse) Phi((x - threshold) / spread), x = level or ln level.
struct PsychometricFunction {
  double threshold = 0;  ///< unit of the level: where the Gaussian is at one half
  double spread = 1;     ///< standard deviation of the Gaussian, > 0; its inverse is the slope
  double guess = 0;      ///< 0.5 when two answers are possible and one is correct
  double lapse = 0;
  Scale scale = Scale::kLinear;

  double operator()(double level) const {
    double z = (level - threshold) / spread;
    if (scale == Scale::kLn) z = level > 0 ? std::log(level / threshold) / spread : -HUGE_VAL;
    return guess + (1 - guess - lapse) * normalCdf(z);
  }
};

}  // namespace presa::psychophysics
