#include "tests/modules/haptics_proxy/surface/support/mesh_oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace presa::test {
namespace {

constexpr std::int32_t kLeaf = 4;

double squaredDistance(const Vec3& low, const Vec3& high, const Vec3& p) {
  return (low - p).cwiseMax(p - high).cwiseMax(Vec3::Zero()).squaredNorm();
}

/// Whether p + s direction with s in [0, end] meets the box; slab test with inverse = 1 / direction.
bool meets(const Vec3& low, const Vec3& high, const Vec3& p, const Vec3& inverse, double end) {
  double from = 0, to = end;
  for (int i = 0; i < 3; ++i) {
    const double one = (low[i] - p[i]) * inverse[i], other = (high[i] - p[i]) * inverse[i];
    if (std::isnan(one) || std::isnan(other)) continue;  // the ray lies in the slab's face
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return from <= to * (1 + 1e-12);
}

/// Whether p + s direction crosses triangle abc: sign of direction . normal, 0 for a miss.
int through(const Vec3& p, const Vec3& direction, double end, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 pa = a - p, pb = b - p, pc = c - p;
  // volumes of the tetrahedra formed by the line and the edges: equal signs mean a crossing
  const double u = direction.dot(pc.cross(pb)), v = direction.dot(pa.cross(pc)), w = direction.dot(pb.cross(pa));
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return 0;
  const double all = u + v + w;
  if (all == 0) return 0;
  const double s = (u * pa + v * pb + w * pc).dot(direction) / (all * direction.squaredNorm());
  if (s < 0 || s > end) return 0;
  return all < 0 ? 1 : -1;
}

Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double squared = edge.squaredNorm();
  if (!(squared > 0)) return a;
  return a + std::clamp((p - a).dot(edge) / squared, 0.0, 1.0) * edge;
}

}  // namespace

Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (squared > 0) {
    const bool within = (b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
                        (a - c).cross(p - c).dot(normal) >= 0;
    if (within) return p - (p - a).dot(normal) / squared * normal;
  }
  Vec3 best = nearestOnSegment(p, a, b);
  for (const Vec3& other : {nearestOnSegment(p, b, c), nearestOnSegment(p, c, a)}) {
    if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
  }
  return best;
}

MeshOracle::MeshOracle(const TriMesh& mesh) : ids_(mesh.triangles.size()), place_of_(mesh.triangles.size()) {
  std::iota(ids_.begin(), ids_.end(), 0);
  std::vector<Vec3> middles;
  std::vector<Corners> given;
  for (const TriMesh::Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    given.push_back({at(0), at(1), at(2)});
    middles.push_back(at(0).cwiseMin(at(1)).cwiseMin(at(2)) + at(0).cwiseMax(at(1)).cwiseMax(at(2)));
  }
  triangles_ = std::move(given);
  nodes_.reserve(mesh.triangles.size());
  nodes_.emplace_back();
  if (!ids_.empty()) split(0, 0, static_cast<std::int32_t>(ids_.size()), middles);
  std::vector<Corners> ordered;
  ordered.reserve(ids_.size());
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    ordered.push_back(triangles_[static_cast<std::size_t>(ids_[i])]);
    place_of_[static_cast<std::size_t>(ids_[i])] = static_cast<std::int32_t>(i);
  }
  triangles_ = std::move(ordered);
}

void MeshOracle::split(std::size_t node, std::int32_t first, std::int32_t count, std::vector<Vec3>& middles) {
  Vec3 low = Vec3::Constant(1e300), high = -low, middle_low = low, middle_high = high;
  for (std::int32_t i = first; i < first + count; ++i) {
    const auto id = static_cast<std::size_t>(ids_[static_cast<std::size_t>(i)]);
    const Corners& t = triangles_[id];
    low = low.cwiseMin(t.a).cwiseMin(t.b).cwiseMin(t.c);
    high = high.cwiseMax(t.a).cwiseMax(t.b).cwiseMax(t.c);
    middle_low = middle_low.cwiseMin(middles[id]);
    middle_high = middle_high.cwiseMax(middles[id]);
  }
  nodes_[node] = {low, high, first, count};
  if (count <= kLeaf) return;
  int axis = 0;
  (middle_high - middle_low).maxCoeff(&axis);
  const std::int32_t half = count / 2;
  std::nth_element(ids_.begin() + first, ids_.begin() + first + half, ids_.begin() + first + count,
                   [&](std::int32_t a, std::int32_t b) {
                     return middles[static_cast<std::size_t>(a)][axis] < middles[static_cast<std::size_t>(b)][axis];
                   });
  const std::size_t children = nodes_.size();
  nodes_.resize(children + 2);
  nodes_[node].first = static_cast<std::int32_t>(children);
  nodes_[node].count = 0;
  split(children, first, half, middles);
  split(children + 1, first + half, count - half, middles);
}

MeshOracle::Nearest MeshOracle::nearest(const Vec3& p, double within) const {
  Nearest best;
  double min = within * within;
  struct Entry {
    std::size_t node;
    double squared;
  };
  std::array<Entry, 128> stack;
  std::size_t count = 0;
  stack[count++] = {0, squaredDistance(nodes_[0].low, nodes_[0].high, p)};
  while (count > 0) {
    const Entry entry = stack[--count];
    if (entry.squared > min) continue;
    const Node& node = nodes_[entry.node];
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = triangles_[static_cast<std::size_t>(i)];
      const Vec3 q = nearestOnTriangle(p, t.a, t.b, t.c);
      if (const double squared = (q - p).squaredNorm(); squared < min) {
        min = squared;
        best = {std::sqrt(squared), q, ids_[static_cast<std::size_t>(i)]};
      }
    }
    if (node.count > 0 || nodes_.size() == 1) continue;
    const auto child = static_cast<std::size_t>(node.first);
    Entry near_one{child, squaredDistance(nodes_[child].low, nodes_[child].high, p)};
    Entry far_one{child + 1, squaredDistance(nodes_[child + 1].low, nodes_[child + 1].high, p)};
    if (far_one.squared < near_one.squared) std::swap(near_one, far_one);
    stack[count++] = far_one;
    stack[count++] = near_one;
  }
  return best;
}

bool MeshOracle::crosses(const Vec3& a, const Vec3& b) const {
  const Vec3 direction = b - a, inverse = direction.cwiseInverse();
  std::array<std::size_t, 128> stack;
  std::size_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[stack[--count]];
    if (!meets(node.low, node.high, a, inverse, 1)) continue;
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = triangles_[static_cast<std::size_t>(i)];
      if (through(a, direction, 1, t.a, t.b, t.c) != 0) return true;
    }
    if (node.count > 0) continue;
    stack[count++] = static_cast<std::size_t>(node.first);
    stack[count++] = static_cast<std::size_t>(node.first) + 1;
  }
  return false;
}

void MeshOracle::near(const Vec3& p, double radius, std::vector<std::int32_t>& found) const {
  found.clear();
  std::array<std::size_t, 128> stack;
  std::size_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[stack[--count]];
    if (squaredDistance(node.low, node.high, p) > radius * radius) continue;
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
      found.push_back(ids_[static_cast<std::size_t>(i)]);
    if (node.count > 0) continue;
    stack[count++] = static_cast<std::size_t>(node.first);
    stack[count++] = static_cast<std::size_t>(node.first) + 1;
  }
}

int MeshOracle::crossings(const Vec3& p, const Vec3& direction) const {
  const Vec3 inverse = direction.cwiseInverse();
  int sum = 0;
  std::array<std::size_t, 128> stack;
  std::size_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[stack[--count]];
    if (!meets(node.low, node.high, p, inverse, 1e300)) continue;
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = triangles_[static_cast<std::size_t>(i)];
      sum += through(p, direction, 1e300, t.a, t.b, t.c);
    }
    if (node.count > 0) continue;
    stack[count++] = static_cast<std::size_t>(node.first);
    stack[count++] = static_cast<std::size_t>(node.first) + 1;
  }
  return sum;
}

int MeshOracle::winding(const Vec3& p) const {
  // directions that are unlikely to coincide with edges of a mesh
  const int one = crossings(p, Vec3(0.5377, 0.6241, 0.5669)), two = crossings(p, Vec3(-0.7211, 0.1873, 0.6669)),
            three = crossings(p, Vec3(0.1319, -0.8237, -0.5515));
  if (one == two && two == three) return one;
  return static_cast<int>(std::lround(solidAngles(p)));
}

double MeshOracle::solidAngles(const Vec3& p) const {
  double sum = 0;
  for (const Corners& t : triangles_) {
    const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

std::array<Vec3, 3> MeshOracle::corners(std::int32_t triangle) const {
  const Corners& t = triangles_[static_cast<std::size_t>(place_of_[static_cast<std::size_t>(triangle)])];
  return {t.a, t.b, t.c};
}

Vec3 MeshOracle::normal(std::int32_t triangle) const {
  const auto [a, b, c] = corners(triangle);
  return (b - a).cross(c - a).normalized();
}

bool InsideWatch::update(const Vec3& p) {
  if (!known_ || mesh_.crosses(last_, p)) inside_ = mesh_.winding(p) != 0;
  known_ = true;
  last_ = p;
  return inside_;
}

}  // namespace presa::test
