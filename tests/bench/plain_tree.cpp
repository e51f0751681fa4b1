#include "tests/bench/plain_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace presa::bench {
namespace {

const Vec3& cornerOf(const TriMesh& mesh, std::int32_t triangle, std::size_t i) {
  return mesh.vertices[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(triangle)][i])];
}

/// Vector from p to the nearest point of the triangle, by the Voronoi region of p [Ericson2004 5.1].
inline Vec3 wayTo(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return -ap;
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return -bp;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return ab * (d1 / (d1 - d3)) - ap;
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return -cp;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return ac * (d2 / (d2 - d6)) - ap;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))) - bp;
  const double inverse = 1 / (va + vb + vc);
  return ab * (vb * inverse) + ac * (vc * inverse) - ap;
}

}  // namespace

PlainTree::PlainTree(const TriMesh& mesh) {
  std::vector<std::int32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<Vec3> middles;
  middles.reserve(order.size());
  for (const std::int32_t t : order) {
    middles.emplace_back((cornerOf(mesh, t, 0) + cornerOf(mesh, t, 1) + cornerOf(mesh, t, 2)) / 3);
  }
  triangles_.reserve(order.size());
  nodes_.reserve(order.size());
  build(order, 0, order.size(), mesh, middles);
  nodes_.shrink_to_fit();
}

std::int32_t PlainTree::build(std::vector<std::int32_t>& order, std::size_t begin, std::size_t end, const TriMesh& mesh,
                              const std::vector<Vec3>& middles) {
  // the root is an inner node even if all triangles fit into one leaf
  if (end - begin <= kLeaf && !nodes_.empty()) return addLeaf(order, begin, end, mesh);
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3& middle = middles[static_cast<std::size_t>(order[i])];
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t half = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end), [&](std::int32_t a, std::int32_t b) {
    const double x = middles[static_cast<std::size_t>(a)][axis], y = middles[static_cast<std::size_t>(b)][axis];
    return x != y ? x < y : a < b;
  });
  const std::size_t n = nodes_.size();
  nodes_.emplace_back();
  bound(nodes_[n], 0, order, begin, half, mesh);
  bound(nodes_[n], 1, order, half, end, mesh);
  const std::int32_t left = build(order, begin, half, mesh, middles);
  const std::int32_t right = build(order, half, end, mesh, middles);
  nodes_[n].child = {left, right};
  return static_cast<std::int32_t>(n);
}

std::int32_t PlainTree::addLeaf(const std::vector<std::int32_t>& order, std::size_t begin, std::size_t end,
                                const TriMesh& mesh) {
  Spheres spheres;
  std::ranges::fill(spheres.radius, -std::numeric_limits<float>::infinity());
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3 &a = cornerOf(mesh, order[i], 0), &b = cornerOf(mesh, order[i], 1), &c = cornerOf(mesh, order[i], 2);
    triangles_.push_back({a, b, c, order[i]});
    const Vec3 middle = (a + b + c) / 3;
    spheres.x[i - begin] = static_cast<float>(middle.x());
    spheres.y[i - begin] = static_cast<float>(middle.y());
    spheres.z[i - begin] = static_cast<float>(middle.z());
    const double squared =
        std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()});
    spheres.radius[i - begin] = static_cast<float>(std::sqrt(squared) * (1 + 1e-5));
  }
  const auto leaf = static_cast<std::int32_t>(spheres_.size());
  spheres_.push_back(spheres);
  triangles_.resize(kLeaf * spheres_.size());
  return ~leaf;
}

void PlainTree::bound(Node& node, std::size_t side, std::vector<std::int32_t>& order, std::size_t begin,
                      std::size_t end, const TriMesh& mesh) const {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      low = low.cwiseMin(cornerOf(mesh, order[i], k));
      high = high.cwiseMax(cornerOf(mesh, order[i], k));
    }
  }
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto down = [&](double x) { return std::nextafter(static_cast<float>(x), -kInfinity); };
  const auto up = [&](double x) { return std::nextafter(static_cast<float>(x), kInfinity); };
  node.low_xy[side] = down(low.x());
  node.low_xy[side + 2] = down(low.y());
  node.high_xy[side] = up(high.x());
  node.high_xy[side + 2] = up(high.y());
  node.z[side] = down(low.z());
  node.z[side + 2] = up(high.z());
}

void PlainTree::query(const Vec3& p, double radius, Found& found) const {
  const float q[3] = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  const Four q_xy{q[0], q[0], q[1], q[1]}, q_z{q[2], q[2], q[2], q[2]};
  const double within = radius * radius;
  double best = std::numeric_limits<double>::infinity();
  Vec3 way = Vec3::Zero();
  found.within.clear();
  struct Waiting {
    std::int32_t node;
    float squared;
  };
  std::array<Waiting, 64> waiting;
  std::size_t count = 0;
  // search distance and its square; the rounding error of float distances is below one part in 10^5 here
  float farthest = std::numeric_limits<float>::infinity(), max = farthest;
  const auto look = [&] {
    max = static_cast<float>(std::max(best, within)) * (1 + 2e-5F);
    farthest = std::sqrt(max);
  };
  const auto leaf = [&](std::size_t at) {
    const Spheres& spheres = spheres_[at];
    float away[kLeaf];  // lower bounds of the distances
    for (int i = 0; i < kLeaf; ++i) {
      const float x = spheres.x[i] - q[0], y = spheres.y[i] - q[1], z = spheres.z[i] - q[2];
      away[i] = std::sqrt(x * x + y * y + z * z) - spheres.radius[i];
    }
    for (std::size_t i = 0; i < kLeaf; ++i) {
      if (away[i] > farthest) continue;
      const Corners& triangle = triangles_[kLeaf * at + i];
      const Vec3 to = wayTo(p, triangle.a, triangle.b, triangle.c);
      const double squared = to.squaredNorm();
      if (squared <= within) found.within.push_back(triangle.id);
      if (squared < best) {
        best = squared;
        way = to;
        look();
      }
    }
  };
  std::int32_t at = 0;
  for (;;) {
    while (at >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      // distance outside of the boxes along x and y, then along z below and above, without branches
      const Four below = node.low_xy - q_xy, above = q_xy - node.high_xy;
      const Four out_xy = below > above ? below : above, out_z = (node.z - q_z) * Four{1, 1, -1, -1};
      const Four positive_xy = out_xy > 0 ? out_xy : Four{}, positive_z = out_z > 0 ? out_z : Four{};
      const Four sum = positive_xy * positive_xy + positive_z * positive_z;
      float near = sum[0] + sum[2], far = sum[1] + sum[3];
      std::int32_t first = node.child[0], second = node.child[1];
      if (far < near) {
        std::swap(near, far);
        std::swap(first, second);
      }
      if (far <= max) waiting[count++] = {second, far};
      if (near > max) goto next;
      at = first;
    }
    at = ~at;
    leaf(static_cast<std::size_t>(at));
  next:
    do {
      if (count == 0) {
        found.nearest = p + way;
        found.distance = std::sqrt(best);
        return;
      }
      --count;
    } while (waiting[count].squared > max);
    at = waiting[count].node;
  }
}

Vec3 PlainTree::rest(const Vec3& start, const Vec3& direction, double radius) const {
  Found found;
  Vec3 p = start;
  for (int i = 0; i < 30; ++i) {
    query(p, 0, found);
    p += (found.distance - radius) * direction;
  }
  return p;
}

}  // namespace presa::bench
