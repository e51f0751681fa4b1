#include "experiments/runner/statistics/psychometric_function.h"

#include <cmath>
#include <limits>

#include "experiments/runner/statistics/distributions.h"

namespace presa::statistics {
namespace detail {

Rise riseAt(PsychometricShape shape, double z) {
  switch (shape) {
    case PsychometricShape::kNormal:
      return {normalCdf(z), normalCdf(-z)};
    case PsychometricShape::kLogistic:
      return {1 / (1 + std::exp(-z)), 1 / (1 + std::exp(z))};
    case PsychometricShape::kWeibull:
      return {-std::expm1(-std::exp(z)), std::exp(-std::exp(z))};
  }
  return {};
}

double axisOf(PsychometricShape shape, double x) { return shape == PsychometricShape::kWeibull ? std::log(x) : x; }

double fromAxis(PsychometricShape shape, double value) {
  return shape == PsychometricShape::kWeibull ? std::exp(value) : value;
}

}  // namespace detail

namespace {

/// z with F(z) = share, 0 < share < 1.
double zAt(PsychometricShape shape, double share) {
  switch (shape) {
    case PsychometricShape::kNormal:
      return normalQuantile(share);
    case PsychometricShape::kLogistic:
      return std::log(share / (1 - share));
    case PsychometricShape::kWeibull:
      return std::log(-std::log1p(-share));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double xAt(const PsychometricFunction& f, double share) {
  return detail::fromAxis(f.shape, detail::axisOf(f.shape, f.location) + f.spread * zAt(f.shape, share));
}

}  // namespace

double PsychometricFunction::probability(double x) const {
  const double z = (detail::axisOf(shape, x) - detail::axisOf(shape, location)) / spread;
  return guess + (1 - guess - lapse) * detail::riseAt(shape, z).reached;
}

std::optional<double> PsychometricFunction::threshold(double p) const {
  if (!(guess < p && p < 1 - lapse)) return std::nullopt;
  return xAt(*this, (p - guess) / (1 - guess - lapse));
}

double PsychometricFunction::jnd() const { return 0.5 * (xAt(*this, 0.75) - xAt(*this, 0.25)); }

}  // namespace presa::statistics
