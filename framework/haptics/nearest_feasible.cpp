// Quadratic programme of the god-object: minimise |y - g|^2 subject to nhat_i . y >= offset_i [Zilles1995 eq. 7].
// Method: enumeration of active sets with zero to three constraints; each set gives y and its multipliers from the Gram
// matrix of the normals. The programme is strictly convex, so the first set with a feasible y and non-negative
// multipliers is the optimum. Nearly dependent sets are skipped. Without a feasible point the least violated candidate
// is returned.
#include "framework/haptics/nearest_feasible.h"

#include <algorithm>
#include <limits>

namespace presa {
namespace {

// Half-spaces whose normals differ by less than 1e-7 rad count as equal: coplanar triangles.
constexpr double kSameNormal = 1 - 0.5e-14;
// Smallest Gram determinant; below it the normals are nearly dependent and define no corner.
constexpr double kDependent = 1e-12;

class Search {
 public:
  Search(const HalfSpaces& all, const Vec3& g) : all_(all), g_(g) {
    double scale = 0;
    for (int i = 0; i < all_.count; ++i) scale = std::max(scale, std::abs(violation(i, g_)));
    tolerance_ = 1e-9 * scale;  // relative to the depth, so that the result does not depend on the unit
  }

  // Tries active sets of size zero, one, two, three.
  Feasible solve() {
    if (consider({}, {}, 0, g_)) return best_;
    const int n = all_.count;
    for (int i = 0; i < n; ++i) {
      if (one(i)) return best_;
    }
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) {
        if (two(i, j)) return best_;
      }
    }
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) {
        for (int k = j + 1; k < n; ++k) {
          if (three(i, j, k)) return best_;
        }
      }
    }
    return best_;
  }

 private:
  const Vec3& normal(int i) const { return all_.item[static_cast<std::size_t>(i)].nhat; }
  // violation of constraint i at y
  double violation(int i, const Vec3& y) const {
    return all_.item[static_cast<std::size_t>(i)].offset - normal(i).dot(y);
  }

  bool one(int i) {
    const double lambda = violation(i, g_);
    return lambda >= 0 && consider({i, -1, -1}, {lambda, 0, 0}, 1, g_ + lambda * normal(i));
  }

  bool two(int i, int j) {
    const double c = normal(i).dot(normal(j));
    const double det = 1 - c * c;
    if (det < kDependent) return false;
    const double ri = violation(i, g_), rj = violation(j, g_);
    const double li = (ri - c * rj) / det, lj = (rj - c * ri) / det;
    return li >= 0 && lj >= 0 && consider({i, j, -1}, {li, lj, 0}, 2, g_ + li * normal(i) + lj * normal(j));
  }

  bool three(int i, int j, int k) {
    Mat3 gram;
    const std::array<int, 3> set{i, j, k};
    Vec3 r;
    for (int a = 0; a < 3; ++a) {
      r[a] = violation(set[static_cast<std::size_t>(a)], g_);
      for (int b = 0; b < 3; ++b) {
        gram(a, b) = normal(set[static_cast<std::size_t>(a)]).dot(normal(set[static_cast<std::size_t>(b)]));
      }
    }
    const double det = gram.determinant();
    if (det < kDependent) return false;
    const Vec3 lambda = gram.inverse() * r;
    if (lambda.minCoeff() < 0) return false;
    return consider(set, {lambda[0], lambda[1], lambda[2]}, 3,
                    g_ + lambda[0] * normal(i) + lambda[1] * normal(j) + lambda[2] * normal(k));
  }

  // Keeps the least violated candidate; true when no constraint is violated.
  bool consider(const std::array<int, 3>& active, const std::array<double, 3>& weight, int count, const Vec3& y) {
    double worst = 0;
    for (int i = 0; i < all_.count; ++i) worst = std::max(worst, violation(i, y));
    if (worst < min_violation_) {
      min_violation_ = worst;
      best_ = {y, active, weight, count};
    }
    return worst <= tolerance_;
  }

  const HalfSpaces& all_;
  const Vec3& g_;
  double tolerance_ = 0;
  double min_violation_ = std::numeric_limits<double>::infinity();
  Feasible best_;
};

}  // namespace

bool HalfSpaces::add(const HalfSpace& half_space, const Vec3& x) noexcept {
  const auto slack = [&x](const HalfSpace& h) { return h.nhat.dot(x) - h.offset; };
  for (int i = 0; i < count; ++i) {
    HalfSpace& other = item[static_cast<std::size_t>(i)];
    if (other.nhat.dot(half_space.nhat) >= kSameNormal) {
      if (slack(half_space) < slack(other)) other = half_space;
      return true;
    }
  }
  if (count < kCapacity) {
    item[static_cast<std::size_t>(count++)] = half_space;
    return true;
  }
  auto* loosest = std::max_element(item.begin(), item.end(),
                                   [&](const HalfSpace& l, const HalfSpace& r) { return slack(l) < slack(r); });
  if (slack(half_space) < slack(*loosest)) *loosest = half_space;
  return false;
}

Feasible nearestFeasible(const HalfSpaces& half_spaces, const Vec3& g) noexcept {
  return Search(half_spaces, g).solve();
}

}  // namespace presa
