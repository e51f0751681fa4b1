#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiments/runner/statistics/interval.h"

/// Linear models by least squares. Nullopt when lengths differ, a value is not finite, the columns are linearly
/// dependent, no degree of freedom is left, or the response is constant. Thread: any.
namespace presa::statistics {

struct Coefficient {
  double value = 0, standard_error = 0;
  double t = 0, p = 1;  ///< against 0, two-sided
  Interval interval;    ///< at the requested level
};

struct LinearFit {
  std::vector<Coefficient> coefficients;  ///< one per column
  std::size_t n = 0;
  std::size_t df = 0;      ///< n - columns - subjects removed by centring
  double residual_sd = 0;  ///< sqrt(sum of squares / df), in the unit of y
  double r_squared = 0;    ///< of the variance about the mean, or about each subject's mean after centring
};

/// Ordinary least squares by QR factorisation. Include a column of ones for an intercept.
std::optional<LinearFit> leastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y, double level = 0.95);

/// One intercept per subject and common slopes: y and the predictors are centred per subject, which equals a dummy per
/// subject [Frisch & Waugh 1933]. When every subject meets the same conditions equally often, the slopes and their
/// standard errors are those of a mixed model with a random intercept, because the predictors do not vary between
/// subjects. For unbalanced data these are the within-subject slopes.
std::optional<LinearFit> withinSubjectRegression(std::span<const double> y,
                                                 std::span<const std::vector<double>> predictors,
                                                 std::span<const int> subjects, double level = 0.95);

/// Exponents of y = c_subject x1^b1 x2^b2 …: withinSubjectRegression of ln y on the ln of the predictors. All values >
/// 0.
std::optional<LinearFit> logLinear(std::span<const double> y, std::span<const std::vector<double>> predictors,
                                   std::span<const int> subjects, double level = 0.95);

/// Force or depth control? Slope of ln(F / k) on ln k.
struct ControlSlope {
  LinearFit fit;       ///< its first coefficient is the slope, with t and p against 0 (depth control)
  double t_force = 0;  ///< of the slope against -1 (force control: the depth falls as 1/k)
  double p_force = 1;
  const Coefficient& slope() const { return fit.coefficients.front(); }
};
/// force [N], stiffness [N/m], both > 0. `others` (mass, friction, > 0) are covariates: they reduce the residual
/// scatter and leave the slope of a balanced design unchanged.
std::optional<ControlSlope> controlSlope(std::span<const double> force, std::span<const double> stiffness,
                                         std::span<const std::vector<double>> others, std::span<const int> subjects,
                                         double level = 0.95);

}  // namespace presa::statistics
