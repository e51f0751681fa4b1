#include "modules/ray/segment_front.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

constexpr double kLonger = 1 + 1e-6;  // covers the rounding of single precision
constexpr int kSpare = 32;            // items by which a front may grow beyond twice its first size

/// Point of the segment nearest to a node's box, found by Newton's method: the squared distance is piecewise quadratic
/// and convex along the segment. The tangent at any point bounds the distance of every point from below.
double nearestToBox(const MeshTree::Node& node, const Segment& segment) noexcept {
  const Mat3 axes = MeshTree::axesOf(node);
  const Vec3 from = axes.transpose() * (segment.a - MeshTree::centerOf(node)),
             way = axes.transpose() * (segment.b - segment.a);
  const Vec3 half(node.half[0], node.half[1], node.half[2]);
  const double square = way.squaredNorm();
  double s = square > 0 ? std::clamp(-from.dot(way) / square, 0.0, 1.0) : 0;
  for (int i = 0; i < 4; ++i) {
    double slope = 0, curvature = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double x = from[k] + s * way[k], beyond = std::max(x - half[k], 0.0) + std::min(x + half[k], 0.0);
      slope += beyond * way[k];
      curvature += beyond != 0 ? way[k] * way[k] : 0;
    }
    if (!(curvature > 0)) break;
    const double next = std::clamp(s - slope / curvature, 0.0, 1.0);
    const bool settled = std::abs(next - s) < 1e-6;
    s = next;
    if (settled) break;
  }
  return s;
}

}  // namespace

SegmentFront::Query::Query(const Segment& of) noexcept
    : segment(of), d(of.b - of.a), per_length(d.norm() > 0 ? 1 / d.norm() : 0) {}

SegmentFront::SegmentFront() : items_(kCapacity), refs_(kCapacity), near_(kCapacity), here_(kCapacity) {}

void SegmentFront::put(int item, const TangentBound& bound, std::int32_t ref) noexcept {
  const auto i = static_cast<std::size_t>(item);
  bind(item, bound);
  refs_[i] = ref;
  if (isTriangle(ref)) {
    const PreparedTriangle t = triangleOf(ref);
    items_[i].centre = (t.a + t.b + t.c) / 3;
    items_[i].radius =
        std::sqrt(std::max({(t.a - items_[i].centre).squaredNorm(), (t.b - items_[i].centre).squaredNorm(),
                            (t.c - items_[i].centre).squaredNorm()}));
  } else {
    const MeshTree::Node& node = tree_->node(ref);
    items_[i].centre = MeshTree::centerOf(node);
    items_[i].radius = kLonger * Vec3(node.half[0], node.half[1], node.half[2]).norm();
  }
}

void SegmentFront::bind(int item, const TangentBound& bound) noexcept {
  const auto i = static_cast<std::size_t>(item);
  items_[i].nhat = bound.nhat;
  items_[i].offset = bound.offset;
}

// Points nearer than the limit to the item lie in the ball of radius limit + radius around its centre.
double SegmentFront::boundOf(int item, const Query& query, double limit) const noexcept {
  const Item& one = items_[static_cast<std::size_t>(item)];
  const double slope = one.nhat.dot(query.d), at_a = one.nhat.dot(query.segment.a) + one.offset;
  const double s =
      std::clamp((one.centre - query.segment.a).dot(query.d) * query.per_length * query.per_length, 0.0, 1.0);
  const double part = std::min(1.0, (limit + one.radius) * query.per_length);
  return at_a + slope * s - std::abs(slope) * part;
}

void SegmentFront::seed(const MeshTree& tree) noexcept {
  tree_ = &tree;
  count_ = near_count_ = fresh_ = 0;
  last_ = -1;
  focus_radius_ = -1;
  put(count_++, {}, MeshTree::kRoot);
}

bool SegmentFront::open(int item) noexcept {
  const MeshTree::Node& node = tree_->node(refs_[static_cast<std::size_t>(item)]);
  const int more = node.isLeaf() ? node.count - 1 : 1;
  if (count_ + more > kCapacity) {
    full_ = true;
    return false;
  }
  const auto refOf = [&](int child) { return node.isLeaf() ? ~(node.first + child) : node.first + child; };
  put(item, {}, refOf(0));
  for (int child = 1; child <= more; ++child) {
    beside(count_, 0);
    put(count_++, {}, refOf(child));
  }
  return true;
}

void SegmentFront::focus(const Segment& segment, double radius, double ahead) noexcept {
  if (radius + movedFrom(segment) <= focus_radius_ && !full_) return;
  full_ = false;
  radius += ahead;
  if (fresh_ > 0 && count_ > 2 * fresh_ + kSpare) seed(*tree_);
  focused_ = segment;
  focus_radius_ = radius;
  const Query query(segment);
  near_count_ = 0;
  for (int item = 0; item < count_; ++item) {
    const double bound = boundOf(item, query, radius);
    if (bound <= radius) beside(item, bound);
  }
}

double SegmentFront::movedFrom(const Segment& segment) const noexcept {
  return std::max((segment.a - focused_.a).norm(), (segment.b - focused_.b).norm());
}

void SegmentFront::beside(int item, double bound) noexcept {
  near_[static_cast<std::size_t>(near_count_)] = item;
  here_[static_cast<std::size_t>(near_count_++)] = bound;
}

double SegmentFront::renew(int item, const Query& query, double limit) noexcept {
  const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
  double distance = 0;
  const double s = nearestToBox(tree_->node(ref), query.segment);
  bind(item, tree_->bound(ref, query.segment.at(s), distance));
  return boundOf(item, query, limit);
}

void SegmentFront::lookAt(int item, const Query& query, Found& best, double& limit) noexcept {
  const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
  if (!isTriangle(ref)) {
    if (renew(item, query, limit) <= limit) expand(item, query, best, limit);
    return;
  }
  const SegmentNearest at = nearest(query.segment, triangleOf(ref));
  // where the segment goes through, the direction bounds nothing
  bind(item, at.distance > 0 ? TangentBound{at.nhat, -at.nhat.dot(at.on_body)} : TangentBound{});
  if (!(at.distance <= limit)) return;
  limit = at.distance - kSlack;
  best = {ref, at};
  last_ = item;
}

// The nearer child first: it is likely to lower the limit.
void SegmentFront::expand(int item, const Query& query, Found& best, double& limit) noexcept {
  const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
  const int second = count_;
  if (!open(item)) {
    const Segment& segment = query.segment;
    const double s = nearestToBox(tree_->node(ref), segment), least = std::max(0.0, boundOf(item, query, limit));
    const Vec3& away = items_[static_cast<std::size_t>(item)].nhat;  // zero inside the box
    const Vec3 nhat = away.squaredNorm() > 0 ? away : Vec3(MeshTree::axesOf(tree_->node(ref)).col(0));
    limit = least - kSlack;
    best = {ref, {.nhat = nhat, .distance = least, .s = s, .on_body = segment.at(s) - least * nhat}};
    return;
  }
  if (isTriangle(refs_[static_cast<std::size_t>(item)])) {
    const int end = count_;
    lookAt(item, query, best, limit);
    for (int child = second; child < end; ++child) lookAt(child, query, best, limit);
    return;
  }
  const std::array<double, 2> least{renew(item, query, limit), renew(second, query, limit)};
  const std::array<int, 2> child{item, second};
  const std::size_t nearer = least[1] < least[0] ? 1 : 0;
  for (const std::size_t i : {nearer, 1 - nearer}) {
    if (least[i] <= limit) expand(child[i], query, best, limit);
  }
}

SegmentFront::Found SegmentFront::nearestOf(const Segment& segment, double limit) noexcept {
  Found best;
  const double wanted = limit;

  const Query query(segment);
  search(query, best, limit);
  if (full_) {
    // most items are left behind: once more from the root, with what was found as a guess
    seed(*tree_);
    beside(0, 0);
    full_ = false;
    limit = isTriangle(best.ref) ? best.at.distance : wanted;
    best = {};
    search(query, best, limit);
  }
  if (fresh_ == 0) fresh_ = count_;
  return best;
}

// The item of the last query comes first, or the one with the lowest bound: it lowers the limit for the others.
void SegmentFront::search(const Query& query, Found& best, double& limit) noexcept {
  const int first = last_ >= 0 ? last_ : lowest(query, limit), count = near_count_;
  if (first < 0) return;
  lookAt(first, query, best, limit);
  const double moved = movedFrom(query.segment);
  for (int n = 0; n < count; ++n) {  // children opened here are looked at at once
    const int item = near_[static_cast<std::size_t>(n)];
    if (here_[static_cast<std::size_t>(n)] > limit + moved) continue;
    if (item != first && boundOf(item, query, limit) <= limit) lookAt(item, query, best, limit);
  }
}

int SegmentFront::lowest(const Query& query, double limit) const noexcept {
  int lowest = -1;
  double least = limit;
  for (int n = 0; n < near_count_; ++n) {
    const int item = near_[static_cast<std::size_t>(n)];
    const double bound = boundOf(item, query, limit);
    if (bound > least) continue;
    least = bound;
    lowest = item;
  }
  return lowest;
}

}  // namespace presa
