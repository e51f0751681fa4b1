#include "framework/geometry/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/geometry/closest_point.h"

namespace presa {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

double squaredTo(const AxisBox& box, const Vec3& p) {
  return (p - p.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
}

/// [Moeller1997]; infinity: the ray misses the triangle.
double hitOf(const Vec3& p, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, across = direction.cross(ac);
  const double determinant = ab.dot(across);
  if (determinant == 0) return kNowhere;
  const Vec3 from = p - a;
  const double u = from.dot(across) / determinant;
  if (!(u >= 0 && u <= 1)) return kNowhere;
  const Vec3 other = from.cross(ab);
  const double v = direction.dot(other) / determinant, t = ac.dot(other) / determinant;
  return v >= 0 && u + v <= 1 && t >= 0 ? t : kNowhere;
}

}  // namespace

SurfaceTree::SurfaceTree(const TriMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
  nodes_.reserve(2 * order_.size());
  build(0, order_.size());
}

std::size_t SurfaceTree::build(std::size_t begin, std::size_t end) {
  const std::size_t index = nodes_.size();
  Node node{{}, begin, end, 0};
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      node.box.low = node.box.low.cwiseMin(corner(order_[i], c));
      node.box.high = node.box.high.cwiseMax(corner(order_[i], c));
    }
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return index;
  Eigen::Index axis = 0;
  (node.box.high - node.box.low).maxCoeff(&axis);
  const std::size_t middle = (begin + end) / 2;
  const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto centre = [&](std::size_t t) { return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis]; };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) { return centre(a) < centre(b); });
  build(begin, middle);
  nodes_[index].right = build(middle, end);
  return index;
}

double SurfaceTree::search(std::size_t index, const Vec3& p, double best, std::size_t& triangle) const {
  const Node& node = nodes_[index];
  if (node.right == 0) {
    for (std::size_t i = node.begin; i < node.end; ++i) {
      const std::size_t t = order_[i];
      const double here = (p - closestOnTriangle(p, corner(t, 0), corner(t, 1), corner(t, 2))).squaredNorm();
      if (here < best) best = here, triangle = t;
    }
    return best;
  }
  std::size_t near = index + 1, far = node.right;
  double near_distance = squaredTo(nodes_[near].box, p), far_distance = squaredTo(nodes_[far].box, p);
  if (far_distance < near_distance) {
    std::swap(near, far);
    std::swap(near_distance, far_distance);
  }
  if (near_distance < best) best = search(near, p, best, triangle);
  if (far_distance < best) best = search(far, p, best, triangle);
  return best;
}

void SurfaceTree::follow(std::size_t index, Ray& ray) const {
  const Node& node = nodes_[index];
  const Vec3 to_low = (node.box.low - ray.p).cwiseProduct(ray.inverse),
             to_high = (node.box.high - ray.p).cwiseProduct(ray.inverse);
  const double enter = std::max(0.0, to_low.cwiseMin(to_high).maxCoeff());
  if (to_low.cwiseMax(to_high).minCoeff() < enter || enter > ray.end) return;
  if (node.right != 0) {
    const Vec3 between = nodes_[node.right].box.low - nodes_[index + 1].box.low;
    const bool left_first = between.dot(ray.direction) >= 0;
    follow(left_first ? index + 1 : node.right, ray);
    follow(left_first ? node.right : index + 1, ray);
    return;
  }
  for (std::size_t i = node.begin; i < node.end; ++i) {
    const std::size_t t = order_[i];
    const double hit = hitOf(ray.p, ray.direction, corner(t, 0), corner(t, 1), corner(t, 2));
    if (hit == kNowhere) continue;
    ++ray.crossings;
    if (ray.ends_at_hit) ray.end = std::min(ray.end, hit);
  }
}

double SurfaceTree::firstHit(const Vec3& p, const Vec3& direction, double bound) const {
  Ray ray{p, direction, direction.cwiseInverse(), bound, true};
  follow(0, ray);
  return ray.end;
}

bool SurfaceTree::isInside(const Vec3& p) const {
  int inside = 0;
  // along no axis, so that they seldom run through an edge
  for (const Vec3& direction : {Vec3(0.62, 0.41, 0.67), Vec3(-0.53, 0.71, 0.46), Vec3(0.37, -0.58, -0.73)}) {
    Ray ray{p, direction, direction.cwiseInverse(), kNowhere, false};
    follow(0, ray);
    inside += static_cast<int>(ray.crossings % 2);
  }
  return inside >= 2;
}

}  // namespace presa
