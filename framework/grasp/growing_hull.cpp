#include "framework/grasp/growing_hull.h"

#include <algorithm>
#include <limits>

#include "framework/grasp/hull_abi.h"
#include "framework/plugin/plugin_loader.h"

namespace presa {
namespace {

constexpr std::size_t kMostPoints = 1200;
constexpr std::size_t kMostHull = 60'000;  // facets of a hull that may still grow: the next takes some seconds
constexpr std::size_t kFirstBatch = 8;     // points by which it grows in the first round
constexpr std::size_t kMostFacets = 4000;  // facets that are looked at in one round
constexpr double kZero = 1e-6;  // a support below this share of the widest wrench is none: see WrenchSpace::span
constexpr double kGraspRounding = 1e-9;  // of the same

/// A space in the coordinates of its basis.
class Reduced {
 public:
  Reduced(const WrenchSpace& space, const WrenchBasis& basis) : space_(space), basis_(basis) {
    Vec6 wrench;
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (const double sign : {-1.0, 1.0}) widest_ = std::max(widest_, space.support(sign * Vec6::Unit(i), wrench));
    }
  }
  double widest() const { return widest_; }  ///< support along an axis, the largest
  Eigen::Index dimension() const { return basis_.cols(); }
  double support(const Eigen::VectorXd& u, Eigen::VectorXd& point) const {
    Vec6 wrench;
    const double h = space_.support(basis_ * u, wrench);
    point = basis_.transpose() * wrench;
    return h;
  }

 private:
  const WrenchSpace& space_;
  const WrenchBasis& basis_;
  double widest_ = 0;
};

/// Origin and wrenches that together have no flat direction: each next pair looks across all of those before.
std::vector<Eigen::VectorXd> firstPoints(const Reduced& space) {
  const Eigen::Index n = space.dimension();
  std::vector<Eigen::VectorXd> points{Eigen::VectorXd::Zero(n)};
  Eigen::MatrixXd across = Eigen::MatrixXd::Identity(n, n);  // projects away what the points span
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::Index widest = 0;
    across.colwise().norm().maxCoeff(&widest);
    const Eigen::VectorXd u = across.col(widest).normalized();
    Eigen::VectorXd ahead, behind;
    space.support(u, ahead);
    space.support(-u, behind);
    points.push_back(ahead);
    points.push_back(behind);
    const Eigen::VectorXd far = across * (ahead.dot(u) > -behind.dot(u) ? ahead : behind);
    if (far.norm() > 0) across -= far.normalized() * (far.normalized().transpose() * across);
  }
  return points;
}

std::vector<HullFacet> hullOf(const std::vector<Eigen::VectorXd>& points, Eigen::Index dimension) {
  std::vector<HullFacet> facets;
  if (dimension == 1) {
    double low = 0, high = 0;
    for (const Eigen::VectorXd& point : points) {
      low = std::min(low, point[0]);
      high = std::max(high, point[0]);
    }
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
    return {{one, high}, {-one, -low}};
  }
  std::vector<double> flat;
  for (const Eigen::VectorXd& point : points) flat.insert(flat.end(), point.begin(), point.end());
  struct Sink {
    std::vector<HullFacet>& facets;
    Eigen::Index dimension;
  } sink{facets, dimension};
  const auto take = [](void* user, const double* normal, double offset) {
    Sink& to = *static_cast<Sink*>(user);
    to.facets.push_back({Eigen::Map<const Eigen::VectorXd>(normal, to.dimension), offset});
  };
  static const auto hull = reinterpret_cast<HullFunction>(pluginSymbol("hull", kHullSymbol));
  hull(flat.data(), static_cast<std::int32_t>(points.size()), static_cast<std::int32_t>(dimension), take, &sink);
  return facets;
}

/// The smallest figure of all supporting half spaces seen.
class UpperBound {
 public:
  UpperBound(const Reduced& space, const FacetFigure& figure) : space_(space), figure_(figure) {}
  double value() const { return value_; }
  const Eigen::VectorXd& normal() const { return normal_; }
  double rounding() const { return kGraspRounding * space_.widest(); }

  /// Support of the space at u, with a point there.
  double look(const Eigen::VectorXd& u, Eigen::VectorXd& point) {
    const double support = space_.support(u, point);
    const double found = figure_(u, support < kZero * space_.widest() ? 0 : support);
    if (found < value_) {
      value_ = found;
      normal_ = u;
    }
    return support;
  }

  /// Looks around the best direction for a better one: where a step away from the point of support helps, the next is
  /// twice as long, else half.
  void descend() {
    Eigen::VectorXd point, next;
    double step = 0.1;
    for (int i = 0; i < 60 && value_ > 0; ++i) {
      const double before = value_;
      const Eigen::VectorXd u = normal_;
      space_.support(u, point);
      const Eigen::VectorXd down = point - u.dot(point) * u;
      if (!(down.norm() > 0)) return;
      look((u - step * down.normalized()).normalized(), next);
      step *= value_ < before ? 2 : 0.5;
    }
  }

 private:
  const Reduced& space_;
  const FacetFigure& figure_;
  double value_ = std::numeric_limits<double>::infinity();
  Eigen::VectorXd normal_;
};

struct Ranked {
  double figure = 0;
  const HullFacet* facet = nullptr;
};

/// The `most` facets with the lowest figures, lowest first.
std::vector<Ranked> lowest(const std::vector<HullFacet>& facets, const FacetFigure& figure, std::size_t most) {
  std::vector<Ranked> order;
  order.reserve(facets.size());
  for (const HullFacet& facet : facets) order.push_back({figure(facet.normal, std::max(0.0, facet.offset)), &facet});
  const std::size_t kept = std::min(most, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                    [](const Ranked& a, const Ranked& b) { return a.figure < b.figure; });
  order.resize(kept);
  return order;
}

/// Points of the space beyond the facets that are too low, at most `most`. A facet that another of them lifts by half
/// or more has to wait.
std::vector<Eigen::VectorXd> growth(const std::vector<Ranked>& order, UpperBound& upper, std::size_t most) {
  constexpr double kAim = ProvenBounds::kMeet / 2;
  std::vector<Eigen::VectorXd> more;
  for (const Ranked& ranked : order) {
    if (more.size() >= most || ranked.figure >= (1 - kAim) * upper.value()) break;
    const HullFacet& facet = *ranked.facet;
    Eigen::VectorXd point;
    const double beyond = upper.look(facet.normal, point) - facet.offset;
    const auto lifts = [&](const Eigen::VectorXd& other) {
      return facet.normal.dot(other) - facet.offset > beyond / 2;
    };
    if (beyond > upper.rounding() && std::ranges::none_of(more, lifts)) more.push_back(point);
  }
  upper.descend();
  return more;
}

}  // namespace

HullFigure smallestFigure(const WrenchSpace& space, const WrenchBasis& basis, const FacetFigure& figure) {
  const Reduced reduced(space, basis);
  std::vector<Eigen::VectorXd> points = firstPoints(reduced);
  UpperBound upper(reduced, figure);
  double at_least = 0;
  while (upper.value() > 0) {
    const std::vector<HullFacet> facets = hullOf(points, reduced.dimension());
    if (facets.empty()) break;  // too flat for a hull: what is known by now
    const std::vector<Ranked> order = lowest(facets, figure, kMostFacets);
    at_least = std::max(at_least, order.front().figure);
    const std::vector<Eigen::VectorXd> more = growth(order, upper, points.size() / 3 + kFirstBatch);
    if (more.empty() || points.size() + more.size() > kMostPoints || facets.size() > kMostHull) break;
    points.insert(points.end(), more.begin(), more.end());
  }
  if (!(upper.value() > 0)) return {{0, 0}, upper.normal()};
  return {{at_least, upper.value()}, upper.normal()};
}

}  // namespace presa
