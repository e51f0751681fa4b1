// Least squares by a column-pivoted Householder QR of columns scaled to unit length; a pivot below 1e-10 of the largest
// counts as linear dependence. Standard errors come from (X'X)^-1 = P R^-1 R^-T P', without forming X'X. Subject
// intercepts are removed by centring [Frisch & Waugh 1933], with fewer degrees of freedom accordingly.
#include "experiments/runner/statistics/regression.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/runner/statistics/distributions.h"

namespace presa::statistics {
namespace {

/// t statistic; 0 when value and error are both 0.
double tOf(double value, double standard_error) { return value == 0 ? 0 : value / standard_error; }

/// `taken_out`: number of parameters already removed from columns and y by centring.
std::optional<LinearFit> fit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y, Eigen::Index taken_out,
                             double level) {
  const Eigen::Index n = columns.rows(), count = columns.cols(), df = n - count - taken_out;
  if (y.size() != n || count == 0 || df <= 0 || !(level > 0 && level < 1)) return std::nullopt;
  if (!columns.allFinite() || !y.allFinite()) return std::nullopt;
  const double total = (y.array() - y.mean()).square().sum();
  const Eigen::VectorXd lengths = columns.colwise().norm();  // scale the columns to length 1 for the rank decision
  if (!(total > 0) || !(lengths.minCoeff() > 0)) return std::nullopt;

  const Eigen::MatrixXd scaled = columns * lengths.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  qr.setThreshold(1e-10);
  if (qr.rank() < count) return std::nullopt;
  const Eigen::VectorXd solution = qr.solve(y);
  const double squares = (y - scaled * solution).squaredNorm();
  // (X'X)^-1 = P R^-1 R^-T P'
  const Eigen::MatrixXd inverse_root =
      qr.colsPermutation() * Eigen::MatrixXd(qr.matrixR().topRows(count).template triangularView<Eigen::Upper>().solve(
                                 Eigen::MatrixXd::Identity(count, count)));

  LinearFit result;
  result.n = static_cast<std::size_t>(n), result.df = static_cast<std::size_t>(df);
  result.residual_sd = std::sqrt(squares / static_cast<double>(df));
  result.r_squared = 1 - squares / total;
  const double reach = studentQuantile(0.5 + level / 2, static_cast<double>(df));
  for (Eigen::Index i = 0; i < count; ++i) {
    const double value = solution[i] / lengths[i];
    const double error = result.residual_sd * inverse_root.row(i).norm() / lengths[i], t = tOf(value, error);
    result.coefficients.push_back({value,
                                   error,
                                   t,
                                   studentTwoSidedP(t, static_cast<double>(df)),
                                   {value - reach * error, value + reach * error}});
  }
  return result;
}

/// Subtracts each subject's mean; returns the number of subjects.
Eigen::Index centre(std::span<const int> subjects, Eigen::Ref<Eigen::VectorXd> values) {
  struct Sum {
    double value = 0;
    double count = 0;
  };
  std::map<int, Sum> sums;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    Sum& sum = sums[subjects[i]];
    sum.value += values[static_cast<Eigen::Index>(i)], ++sum.count;
  }
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const Sum& sum = sums[subjects[i]];
    values[static_cast<Eigen::Index>(i)] -= sum.value / sum.count;
  }
  return static_cast<Eigen::Index>(sums.size());
}

/// False for a predictor that is constant within each subject, up to rounding.
bool variesWithin(const Eigen::VectorXd& centred, const std::vector<double>& values) {
  const double largest = std::abs(
      *std::max_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  return centred.cwiseAbs().maxCoeff() > 1e-12 * largest;
}

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(),
                 [](double v) { return v > 0 ? std::log(v) : std::numeric_limits<double>::quiet_NaN(); });
  return result;
}

}  // namespace

std::optional<LinearFit> leastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y, double level) {
  return fit(columns, y, 0, level);
}

std::optional<LinearFit> withinSubjectRegression(std::span<const double> y,
                                                 std::span<const std::vector<double>> predictors,
                                                 std::span<const int> subjects, double level) {
  const auto is_paired = [&](const std::vector<double>& x) { return x.size() == y.size(); };
  if (y.empty() || subjects.size() != y.size() || !std::all_of(predictors.begin(), predictors.end(), is_paired)) {
    return std::nullopt;
  }
  const auto n = static_cast<Eigen::Index>(y.size());
  Eigen::VectorXd response = Eigen::Map<const Eigen::VectorXd>(y.data(), n);
  const Eigen::Index subject_count = centre(subjects, response);
  Eigen::MatrixXd columns(n, static_cast<Eigen::Index>(predictors.size()));
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    const std::vector<double>& values = predictors[static_cast<std::size_t>(i)];
    Eigen::VectorXd column = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
    centre(subjects, column);
    if (!variesWithin(column, values)) return std::nullopt;
    columns.col(i) = column;
  }
  if (!variesWithin(response, std::vector<double>(y.begin(), y.end()))) return std::nullopt;
  return fit(columns, response, subject_count, level);
}

std::optional<LinearFit> logLinear(std::span<const double> y, std::span<const std::vector<double>> predictors,
                                   std::span<const int> subjects, double level) {
  std::vector<std::vector<double>> logs;
  for (const std::vector<double>& predictor : predictors) logs.push_back(logarithms(predictor));
  return withinSubjectRegression(logarithms(y), logs, subjects, level);
}

std::optional<ControlSlope> controlSlope(std::span<const double> force, std::span<const double> stiffness,
                                         std::span<const std::vector<double>> others, std::span<const int> subjects,
                                         double level) {
  if (force.size() != stiffness.size()) return std::nullopt;
  std::vector<double> depth(force.begin(), force.end());
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] /= stiffness[i];
  std::vector<std::vector<double>> predictors{{stiffness.begin(), stiffness.end()}};
  predictors.insert(predictors.end(), others.begin(), others.end());
  std::optional<LinearFit> fitted = logLinear(depth, predictors, subjects, level);
  if (!fitted) return std::nullopt;
  ControlSlope result{*std::move(fitted)};
  result.t_force = tOf(result.slope().value + 1, result.slope().standard_error);
  result.p_force = studentTwoSidedP(result.t_force, static_cast<double>(result.fit.df));
  return result;
}

}  // namespace presa::statistics
