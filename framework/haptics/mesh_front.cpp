// Distance, sweep and crossing queries of a sphere against a mesh, through a tracked front of its bounding-volume
// hierarchy. Every item of the front has a tangent plane that bounds its distance from below at every point
// (MeshTree::bound); only items whose bound allows a touch are examined, and examined nodes are replaced by their
// children. Sweeps use Newton's method on convex distances (convex_piece.h). Invariant: the front always covers the
// mesh, or the cut that it was seeded from.
#include "framework/haptics/mesh_front.h"

#include <algorithm>
#include <cmath>

namespace presa {

void MeshFront::seed(const MeshTree& tree, std::span<const std::int32_t> nodes, const Vec3& p) noexcept {
  tree_ = &tree;
  seed_count_ = static_cast<int>(nodes.size());
  if (nodes.data() != seeds_.data()) std::ranges::copy(nodes, seeds_.begin());
  full_ = false;
  focus_radius_ = -1;
  count_ = near_count_ = fresh_ = 0;
  for (const std::int32_t node : nodes) {
    double distance = 0;
    put(count_++, tree.bound(node, p, distance), node);
  }
}

bool MeshFront::open(int item) noexcept {
  const MeshTree::Node& node = tree_->node(refs_[static_cast<std::size_t>(item)]);
  const int more = node.isLeaf() ? node.count - 1 : 1;
  if (count_ + more > kCapacity) {
    full_ = true;
    return false;
  }
  if (node.isLeaf()) {
    put(item, {}, ~node.first);
    for (std::int32_t f = 1; f < node.count; ++f) add({}, ~(node.first + f));
  } else {
    put(item, {}, node.first);
    add({}, node.first + 1);
  }
  return true;
}

Nearest MeshFront::nearestOfNode(std::int32_t node, const Vec3& p) const noexcept {
  double distance = 0;
  const TangentBound bound = tree_->bound(node, p, distance);
  if (distance > 0) return {bound.nhat, distance};
  return {MeshTree::axesOf(tree_->node(node)).col(0), 0};
}

void MeshFront::focus(const Vec3& p, double radius, double step) noexcept {
  constexpr double kStepsAhead = 3;
  constexpr int kFew = 24;
  if ((p - focus_).norm() + radius <= focus_radius_) return;
  if (near_count_ < kFew) radius += kStepsAhead * step;
  focus_ = p;
  focus_radius_ = radius;
  near_count_ = 0;
  here_at_.setConstant(std::numeric_limits<double>::quiet_NaN());  // the cached bounds belong to other items
  for (int begin = 0; begin < count_; begin += kBlock) {
    std::array<double, kBlock> at;
    for (int j = 0; j < kBlock; ++j) at[static_cast<std::size_t>(j)] = boundAt(begin + j, p);
    const int end = std::min(kBlock, count_ - begin);
    for (int j = 0; j < end; ++j) {
      near_[static_cast<std::size_t>(near_count_)] = begin + j;
      near_count_ += at[static_cast<std::size_t>(j)] <= radius;
    }
  }
}

double MeshFront::firstTouch(const Vec3& x, const Vec3& move, double reach, double r,
                             const SweepTolerance& tolerance) noexcept {
  const double length = move.norm();
  const int count = near_count_;
  if (here_at_ != x) {
    for (int n = 0; n < count; ++n) here_[static_cast<std::size_t>(n)] = boundAt(near_[static_cast<std::size_t>(n)], x);
    here_at_ = x;
  }
  const auto look = [&](std::size_t n) {
    const int item = near_[n];
    const auto i = static_cast<std::size_t>(item);
    const double growth = nx_[i] * move.x() + ny_[i] * move.y() + nz_[i] * move.z();
    if (here_[n] + std::min(0.0, reach * growth) <= r) sweep(item, x, move, reach, r, tolerance);
  };
  // start with the nearest item: if it is hit, the others are usually out of reach
  std::size_t first = 0;
  double min = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    if (here_[n] >= min || marks_[static_cast<std::size_t>(near_[n])] == mark_) continue;
    min = here_[n];
    first = n;
  }
  if (min > r + reach * length) return reach;
  look(first);
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    if (here_[n] <= r + reach * length && n != first) look(n);
  }
  return reach;
}

namespace {

/// Lower bound on [0, limit] of the maximum of two lines, given by value and slope at 0 and at `limit`: a lower bound
/// of every convex function that lies above both lines.
double minOfTangents(double at_begin, double falls, double at_end, double rises, double limit) noexcept {
  if (falls >= 0) return std::max(at_begin, at_end - std::max(rises, 0.0) * limit);
  if (rises <= 0) return std::max(at_end, at_begin + falls * limit);
  const double s = (at_end - at_begin - rises * limit) / (falls - rises);  // their intersection
  return at_begin + falls * std::clamp(s, 0.0, limit);
}

}  // namespace

bool MeshFront::staysClear(int item, const Vec3& x, const Vec3& move, double reach, double r) noexcept {
  const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
  const auto i = static_cast<std::size_t>(item);
  const Vec3 nhat(nx_[i], ny_[i], nz_[i]);
  const double here = nhat.dot(x) + offset_[i], falls = nhat.dot(move);
  // besides the known tangent, take the one at the end of the path, which the next leg will need anyway
  const Vec3 end = x + reach * move;
  TangentBound bound;
  double distance = 0;
  if (ref < 0) {
    const Nearest at = nearest(triangle(~ref), end);
    distance = at.distance;
    if (distance != 0) bound = {at.nhat, distance - at.nhat.dot(end)};
  } else {
    bound = tree_->bound(ref, end, distance);
  }
  bind(item, bound);
  return minOfTangents(here, falls, distance, bound.nhat.dot(move), reach) >= r;
}

void MeshFront::sweep(int item, const Vec3& x, const Vec3& move, double& reach, double r,
                      const SweepTolerance& tolerance) noexcept {
  const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
  const bool marked = marks_[static_cast<std::size_t>(item)] == mark_;
  if (ref < 0) {
    if (marked || staysClear(item, x, move, reach, r - tolerance.graze)) return;
    const PreparedTriangle piece = triangle(~ref);
    const auto nearest_to = [&](const Vec3& p) { return nearest(piece, p); };
    const Nearest at = nearest_to(x);
    bind(item, at.distance != 0 ? TangentBound{at.nhat, at.distance - at.nhat.dot(x)} : TangentBound{});
    if (at.distance > r - tolerance.graze && staysClear(item, x, move, reach, r - tolerance.graze)) return;
    reach = std::min(reach, firstTouchOf(nearest_to, at, x, move, reach, r, tolerance.touch));
    return;
  }
  if (staysClear(item, x, move, reach, r * (1 + 1e-12))) return;
  double distance = 0;
  const TangentBound bound = tree_->bound(ref, x, distance);
  bind(item, bound);
  if (distance > r && staysClear(item, x, move, reach, r * (1 + 1e-12))) return;
  const int old_count = count_;
  if (!open(item)) {
    const auto nearest_to = [&](const Vec3& p) { return nearestOfNode(ref, p); };
    if (!marked && distance > r)
      reach = std::min(reach, firstTouchOf(nearest_to, {bound.nhat, distance}, x, move, reach, r, tolerance.touch));
    return;
  }
  const int new_count = count_;
  sweep(item, x, move, reach, r, tolerance);
  for (int child = old_count; child < new_count; ++child) sweep(child, x, move, reach, r, tolerance);
}

double MeshFront::clearance(const Vec3& p) const noexcept {
  double min = std::numeric_limits<double>::infinity();
  for (int item = 0; item < count_; ++item) min = std::min(min, boundAt(item, p));
  return min;
}

bool MeshFront::crosses(std::span<const Vec3> way, bool focused) noexcept {
  constexpr double kRounding = 2e-14;  // relative to the coordinates
  double largest = 0;
  for (const Vec3& p : way) largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  const double rounding = kRounding * largest;
  const int count = focused ? near_count_ : count_;
  for (int n = 0; n < count; ++n) {
    const int item = focused ? near_[static_cast<std::size_t>(n)] : n;
    if (comesNear(item, way, rounding) && crossesItem(item, way, rounding)) return true;
  }
  return false;
}

bool MeshFront::crossesItem(int item, std::span<const Vec3> way, double rounding) noexcept {
  const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
  if (ref < 0) {
    bool crossed = false;
    for (std::size_t k = 1; k < way.size() && !crossed; ++k)
      crossed = crossesFacet(tree_->facet(~ref), way[k - 1], way[k]);
    return crossed;
  }
  Vec3 low = way[0], high = way[0];
  for (const Vec3& p : way) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double distance = 0;
  bind(item, tree_->bound(ref, 0.5 * (low + high), distance));
  if (distance > 0.5 * (high - low).norm() * (1 + 1e-9) || !comesNear(item, way, rounding)) return false;
  const int old_count = count_;
  if (!open(item)) return false;  // the node is solid now, and full() reports it as lost coverage
  const int new_count = count_;
  bool crossed = crossesItem(item, way, rounding);
  for (int child = old_count; child < new_count && !crossed; ++child) crossed = crossesItem(child, way, rounding);
  return crossed;
}

// An edge belongs to both of its triangles, so a segment through the edge cannot slip between them.
bool MeshFront::crossesFacet(const MeshTree::Facet& facet, const Vec3& a, const Vec3& b) const noexcept {
  constexpr double kRounding = 1e-13;
  const Vec3 &u = tree_->corner(facet, 0), &v = tree_->corner(facet, 1), &w = tree_->corner(facet, 2);
  const Vec3 normal = (v - u).cross(w - u);
  if ((normal.dot(a - u) > 0) == (normal.dot(b - u) > 0)) return false;
  const Vec3 way = b - a;
  bool all_left = true, all_right = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 from = tree_->corner(facet, i) - a, to = tree_->corner(facet, (i + 1) % 3) - a;
    const double side = way.dot(from.cross(to)), rounding = kRounding * way.norm() * from.norm() * to.norm();
    all_left = all_left && side >= -rounding;
    all_right = all_right && side <= rounding;
  }
  return all_left || all_right;
}

}  // namespace presa
