// With the set S of contacts that press, f_i = -k (J_i u + gap_i), so that u solves a system of six unknowns only:
//   (Q + k sum_S J_i J_i^T) u = r - k sum_S gap_i J_i,
// however many contacts there are. A set fits if exactly its own contacts overlap after the step. Equivalently u is the
// minimum of the convex energy E(u) = u Q u / 2 - r u + k / 2 sum of min(0, J_i u + gap_i)^2: a pivot goes from u towards
// the solution of its set, as far as E falls, so that no set comes twice.
#include "framework/haptics/contact_lcp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace presa {
namespace {

constexpr int kMaxPivots = 40;
constexpr int kBisections = 30;  // of a way, when E rises before its end
constexpr double kFits = 1e-12;  // gap of a contact that counts as none [m]

Vec6 rowOf(const PressedPoint& contact) noexcept {
  Vec6 row;
  row << contact.nhat, contact.p.cross(contact.nhat);
  return row;
}

double gapAfter(const PressedPoint& contact, const Vec6& u) noexcept { return rowOf(contact).dot(u) + contact.gap; }

/// The same step for up to four contacts that overlap, from the inverse of Q: their forces f solve
/// (1 / k + J Q^-1 J^T) f = -(gap + J Q^-1 r).
template <int kCount>
Vec6 stepOfFew(const ContactProblem& problem, const std::array<const PressedPoint*, 4>& pressing) noexcept {
  Eigen::Matrix<double, 6, kCount> rows;
  Eigen::Matrix<double, kCount, 1> gaps;
  for (int i = 0; i < kCount; ++i) {
    rows.col(i) = rowOf(*pressing[static_cast<std::size_t>(i)]);
    gaps[i] = pressing[static_cast<std::size_t>(i)]->gap;
  }
  const Eigen::Matrix<double, 6, kCount> gives = *problem.inverse * rows;
  const Vec6 free = *problem.inverse * problem.r;
  Eigen::Matrix<double, kCount, kCount> resistance = rows.transpose() * gives;
  resistance.diagonal().array() += 1 / problem.k;
  return free - gives * resistance.llt().solve(gaps + rows.transpose() * free);
}

/// Step of the set of contacts that overlap after u.
Vec6 stepOf(const ContactProblem& problem, const BoundedList<PressedPoint>& contacts, const Vec6& u) noexcept {
  if (problem.inverse != nullptr) {
    std::array<const PressedPoint*, 4> pressing{};
    std::size_t count = 0;
    for (const PressedPoint& one : contacts) {
      if (!(gapAfter(one, u) < 0)) continue;
      if (count < pressing.size()) pressing[count] = &one;
      ++count;
    }
    if (count == 0) return *problem.inverse * problem.r;
    if (count == 1) return stepOfFew<1>(problem, pressing);
    if (count == 2) return stepOfFew<2>(problem, pressing);
    if (count == 3) return stepOfFew<3>(problem, pressing);
    if (count == 4) return stepOfFew<4>(problem, pressing);
  }
  Mat6 Q = problem.Q;
  Vec6 r = problem.r;
  for (const PressedPoint& one : contacts) {
    if (!(gapAfter(one, u) < 0)) continue;
    const Vec6 row = rowOf(one);
    Q.noalias() += problem.k * row * row.transpose();
    r -= problem.k * one.gap * row;
  }
  return Q.llt().solve(r);
}

bool sameSet(const BoundedList<PressedPoint>& contacts, const Vec6& u, const Vec6& next) noexcept {
  return std::all_of(contacts.begin(), contacts.end(), [&](const PressedPoint& one) {
    const double before = gapAfter(one, u), after = gapAfter(one, next);
    return (before < 0) == (after < 0) || std::abs(after) <= kFits;
  });
}

/// Part of the way from u by `way` at which E is lowest. Its slope along the way grows.
double lowest(const ContactProblem& problem, const BoundedList<PressedPoint>& contacts, const Vec6& u,
              const Vec6& way) noexcept {
  const double linear = way.dot(problem.Q * u - problem.r), square = way.dot(problem.Q * way);
  std::array<double, kMaxPressed> gap, closing;
  const std::size_t count = std::min(contacts.size(), kMaxPressed);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec6 row = rowOf(contacts[i]);
    gap[i] = row.dot(u) + contacts[i].gap;
    closing[i] = row.dot(way);
  }
  const auto slope = [&](double t) {
    double sum = linear + t * square;
    for (std::size_t i = 0; i < count; ++i) sum += problem.k * std::min(0.0, gap[i] + t * closing[i]) * closing[i];
    return sum;
  };
  if (slope(1) <= 0) return 1;
  double low = 0, high = 1;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    (slope(middle) > 0 ? high : low) = middle;
  }
  return low;
}

}  // namespace

void addDeepest(const PressedPoint& point, BoundedList<PressedPoint>& points) noexcept {
  if (points.add(point) != nullptr) return;
  PressedPoint* highest = std::max_element(points.begin(), points.end(),
                                           [](const PressedPoint& a, const PressedPoint& b) { return a.gap < b.gap; });
  if (point.gap < highest->gap) *highest = point;
}

Pivots solveContacts(const ContactProblem& problem, BoundedList<PressedPoint>& contacts, Vec6& u) noexcept {
  Pivots pivots{0, false};
  while (!pivots.exact && pivots.count < kMaxPivots) {
    ++pivots.count;
    const Vec6 next = stepOf(problem, contacts, u);
    pivots.exact = sameSet(contacts, u, next);
    u = pivots.exact ? next : Vec6(u + lowest(problem, contacts, u, next - u) * (next - u));
  }
  for (PressedPoint& one : contacts) one.force = std::max(0.0, -problem.k * gapAfter(one, u));
  return pivots;
}

}  // namespace presa
