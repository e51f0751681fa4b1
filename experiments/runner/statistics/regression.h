#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiments/runner/statistics/interval.h"

/// Linear models by least squares. No result (nullopt) when lengths differ, a value is not finite, the columns depend on
/// each other, no degree of freedom is left or the response does not vary. Thread: any.
namespace presa::statistics {

struct Coefficient {
  double value = 0, standard_error = 0;
  double t = 0, p = 1;  ///< against 0, two-sided
  Interval interval;    ///< at the level asked for
};

struct LinearFit {
  std::vector<Coefficient> coefficients;  ///< one per column
  std::size_t n = 0;
  std::size_t df = 0;      ///< n - columns - subjects taken out
  double residual_sd = 0;  ///< sqrt(sum of squares / df), in the unit of y
  double r_squared = 0;    ///< of the variance about the mean, or about each subject's where those were taken out
};

/// Ordinary least squares by a QR factorisation. Put a column of ones where there is to be an intercept.
std::optional<LinearFit> leastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y, double level = 0.95);

/// One intercept per subject, common slopes of the predictors: y and predictors less their means per subject (equal to a
/// dummy per subject [Frisch & Waugh 1933]). Where every subject meets the same conditions the same number of times, the
/// predictors do not vary between subjects, so nothing about the slopes is in the subjects' means, and the slopes and their
/// standard errors are those of a mixed model with a random intercept. Unbalanced data: the slopes within subjects.
std::optional<LinearFit> withinSubjectRegression(std::span<const double> y,
                                                 std::span<const std::vector<double>> predictors,
                                                 std::span<const int> subjects, double level = 0.95);

/// The exponents of y = c_subject x1^b1 x2^b2 …: the regression above of ln y on the ln of the predictors. All values > 0.
std::optional<LinearFit> logLinear(std::span<const double> y, std::span<const std::vector<double>> predictors,
                                   std::span<const int> subjects, double level = 0.95);

/// Did the subject hold a force or a depth? Slope of ln(F / k) on ln k.
struct ControlSlope {
  LinearFit fit;       ///< its first coefficient is the slope: t and p against 0, depth control
  double t_force = 0;  ///< of the slope against -1, force control: the depth gives way as the stiffness grows
  double p_force = 1;
  const Coefficient& slope() const { return fit.coefficients.front(); }
};
/// force [N], stiffness [N/m], > 0; `others` (mass, friction, > 0) take their part out of the scatter and leave the slope of a
/// balanced design as it is.
std::optional<ControlSlope> controlSlope(std::span<const double> force, std::span<const double> stiffness,
                                         std::span<const std::vector<double>> others, std::span<const int> subjects,
                                         double level = 0.95);

}  // namespace presa::statistics
