// Point-set registration: rotation by the SVD of the cross-covariance [Arun1987], with a sign fix against reflections
// [Umeyama1991], translation from the centroids. The condition number and the standard errors come from the normal
// equations of the linearised problem, with angles scaled to arcs of 0.1 m.
#include "devices/percro_arm/calibration/linked_bases.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace presa {
namespace {

constexpr double kArc = 0.1;  // [m]: angles are weighed by the arc at this distance

template <class... Numbers>
std::string format(const char* pattern, Numbers... numbers) {
  std::array<char, 240> text;
  std::snprintf(text.data(), text.size(), pattern, numbers...);
  return text.data();
}

std::string refusalOf(const LinkedBases& fit) {
  if (!(fit.condition <= kMaxCondition)) {
    const double across = std::hypot(fit.spread[1], fit.spread[2]);
    return format(
        "the motion is too poor to tell how the bases are turned: its points spread by %.1f mm along one line and by "
        "%.1f mm "
        "beside it (condition of the normal equations %.3g, at most %.3g): move at least 30 mm to either side of that "
        "line",
        fit.spread[0] * 1e3, across * 1e3, fit.condition, kMaxCondition);
  }
  if (!(fit.residual <= kMaxResidual))
    return format(
        "the two did not hold one point: %.2f mm remain between them (at most %.1f mm): the link was loose, the arms "
        "were "
        "not homed, or the samples are not of the same moments",
        fit.residual * 1e3, kMaxResidual * 1e3);
  return {};
}

}  // namespace

LinkedBases fitBases(std::span<const LinkedSample> samples) {
  LinkedBases fit;
  fit.condition = std::numeric_limits<double>::infinity();
  if (samples.size() < kMinSamples) {
    fit.refusal = format("%zu samples are too few, at least %zu are needed", samples.size(), kMinSamples);
    return fit;
  }
  const auto count = static_cast<double>(samples.size());
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  for (const LinkedSample& s : samples) a += s.p_A / count, b += s.p_B / count;
  Mat3 covariance = Mat3::Zero(), scatter = Mat3::Zero();
  for (const LinkedSample& s : samples) {
    covariance += (s.p_B - b) * (s.p_A - a).transpose() / count;
    scatter += (s.p_A - a) * (s.p_A - a).transpose() / count;
  }
  if (!covariance.allFinite() || !scatter.allFinite()) {
    fit.refusal = "a sample is no number";
    return fit;
  }
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 flip = Mat3::Identity();
  flip(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;  // a turn, no mirror
  const Mat3 turn = svd.matrixV() * flip * svd.matrixU().transpose();
  fit.X_AB = {a - turn * b, Quat(turn)};

  double squares = 0;
  for (const LinkedSample& s : samples) squares += (s.p_A - fit.X_AB * s.p_B).squaredNorm();
  fit.residual = std::sqrt(squares / count);

  // about the centroid the normal equations fall apart: I for the shift, sum (|r|^2 I - r r') for the turn
  const Mat3 information = scatter.trace() * Mat3::Identity() - scatter;
  const Vec3 turning = Eigen::SelfAdjointEigenSolver<Mat3>(information, Eigen::EigenvaluesOnly).eigenvalues();
  const double weakest = std::max(0.0, turning[0]) / (kArc * kArc), strongest = turning[2] / (kArc * kArc);
  fit.condition = std::max(1.0, strongest) / std::min(1.0, weakest);
  const Vec3 along = Eigen::SelfAdjointEigenSolver<Mat3>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  fit.spread = along.reverse().cwiseMax(0).cwiseSqrt();
  fit.refusal = refusalOf(fit);
  if (!fit.refusal.empty()) return fit;

  const double variance = squares / (3 * count - 6);
  const Mat3 turn_variance = variance / count * information.inverse();
  const Vec3 lever = turn * b;
  Mat3 cross;
  cross << 0, -lever.z(), lever.y(), lever.z(), 0, -lever.x(), -lever.y(), lever.x(), 0;
  fit.angle_error = std::sqrt(turn_variance.trace());
  fit.position_error = std::sqrt(3 * variance / count + (cross * turn_variance * cross.transpose()).trace());
  return fit;
}

}  // namespace presa
