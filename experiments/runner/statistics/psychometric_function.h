#pragma once
#include <optional>

namespace presa::statistics {

/// Shape of the rise F(x) in [0, 1] between the asymptotes. x has any unit; location has the same unit, and so has the
/// spread of the first two shapes.
enum class PsychometricShape {
  kNormal,    ///< Phi((x - location) / spread): spread is the standard deviation
  kLogistic,  ///< 1 / (1 + exp(-(x - location) / spread))
  kWeibull,   ///< 1 - exp(-(x / location)^(1 / spread)), x > 0: location at F = 1 - 1/e, spread without unit, of ln x
};

/// P(x) = guess + (1 - guess - lapse) F(x).
struct PsychometricFunction {
  PsychometricShape shape = PsychometricShape::kNormal;
  double location = 0, spread = 1;
  double guess = 0, lapse = 0;  ///< distance of the lower asymptote from 0 and of the upper one from 1

  double probability(double x) const;
  /// x with P(x) = p, asymptotes included; nullopt unless guess < p < 1 - lapse.
  std::optional<double> threshold(double p) const;
  /// Point of subjective equality, threshold(0.5), for tasks with the answer "the comparison is greater".
  std::optional<double> pse() const { return threshold(0.5); }
  /// Just noticeable difference: half the distance between F = 1/4 and F = 3/4; 0.67449 spread for kNormal.
  double jnd() const;
};

namespace detail {

/// F and 1 - F, each exact in its own tail.
struct Rise {
  double reached, left;
};
Rise riseAt(PsychometricShape shape, double z);
/// Maps x to the axis on which a shape is F((axis - location) / spread): ln x for kWeibull, x otherwise.
double axisOf(PsychometricShape shape, double x);
double fromAxis(PsychometricShape shape, double value);

}  // namespace detail
}  // namespace presa::statistics
