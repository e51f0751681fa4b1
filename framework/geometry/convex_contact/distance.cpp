// The method of Gilbert, Johnson and Keerthi: the point of B - A nearest to the origin is found by a simplex of up to four
// of its support points. Invariant: v is the point of the simplex nearest to the origin, and every member carries weight.
#include "framework/geometry/convex_contact/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "framework/geometry/index.h"

namespace presa {
namespace {

constexpr std::size_t kSearchedVertices = 24;  // looked at one by one
constexpr int kMaxIterations = 64;
constexpr double kConverged = 1e-8;  // what another support point would gain, in relation to the distance
constexpr double kTouching = 1e-12;  // distance in relation to the coordinates
constexpr double kNoInside = 1e-12;  // volume of a tetrahedron without inside, in relation to its edges

/// A point of B - A, and the points that it comes from.
struct Vertex {
  Vec3 w, on_a, on_b;
};

struct Simplex {
  std::array<Vertex, 4> vertices;
  std::array<double, 4> weights{};
  std::size_t count = 0;
};

/// A candidate for the nearest point: members of the simplex with their weights.
struct SimplexPart {
  std::array<std::size_t, 3> of{};
  std::array<double, 3> weights{};
  std::size_t count = 0;
  Vec3 v = Vec3::Zero();
};

SimplexPart ofSegment(const Simplex& s, std::size_t i, std::size_t j) noexcept {
  const Vec3 &a = s.vertices[i].w, &b = s.vertices[j].w;
  const Vec3 ab = b - a;
  const double along = -a.dot(ab), length = ab.squaredNorm();
  if (!(along > 0)) return {{i}, {1}, 1, a};
  if (!(along < length)) return {{j}, {1}, 1, b};
  const double t = along / length;
  return {{i, j}, {1 - t, t}, 2, a + t * ab};
}

// Regions of a triangle [Ericson2005, 5.1.5]; within it, v is taken along the normal, where it keeps its digits however
// near the origin is.
SimplexPart ofTriangle(const Simplex& s, std::size_t i, std::size_t j, std::size_t k) noexcept {
  const Vec3 &a = s.vertices[i].w, &b = s.vertices[j].w, &c = s.vertices[k].w;
  const Vec3 ab = b - a, ac = c - a, normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  const double u = (b.cross(c)).dot(normal), v = (c.cross(a)).dot(normal), w = (a.cross(b)).dot(normal);
  if (u > 0 && v > 0 && w > 0 && area > 0)
    return {{i, j, k}, {u / area, v / area, w / area}, 3, a.dot(normal) / area * normal};
  SimplexPart best = ofSegment(s, i, j);
  for (const SimplexPart& edge : {ofSegment(s, j, k), ofSegment(s, k, i)}) {
    if (edge.v.squaredNorm() < best.v.squaredNorm()) best = edge;
  }
  return best;
}

/// Whether the origin lies within the tetrahedron. If not, `best` is its nearest part.
bool insideTetrahedron(const Simplex& s, SimplexPart& best) noexcept {
  constexpr std::array<std::array<std::size_t, 4>, 4> kFaces{{{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}}};
  bool inside = true;
  double nearest = 1e300;
  for (const auto& [i, j, k, opposite] : kFaces) {
    const Vec3 &a = s.vertices[i].w, &b = s.vertices[j].w, &c = s.vertices[k].w, &d = s.vertices[opposite].w;
    const Vec3 normal = (b - a).cross(c - a);
    const double volume = (d - a).dot(normal), of_origin = -a.dot(normal);
    const bool is_flat = std::abs(volume) <= kNoInside * normal.norm() * (d - a).norm();
    if (!is_flat && of_origin * volume >= 0) continue;  // the origin is on the inner side
    inside = false;
    const SimplexPart face = ofTriangle(s, i, j, k);
    if (face.v.squaredNorm() >= nearest) continue;
    nearest = face.v.squaredNorm();
    best = face;
  }
  return inside;
}

/// Reduces the simplex to the part nearest to the origin, which becomes v. False: the origin lies within.
bool reduce(Simplex& s, Vec3& v) noexcept {
  SimplexPart best{{0}, {1}, 1, s.vertices[0].w};
  if (s.count == 2) best = ofSegment(s, 0, 1);
  if (s.count == 3) best = ofTriangle(s, 0, 1, 2);
  if (s.count == 4 && insideTetrahedron(s, best)) return false;
  const Simplex all = s;
  s.count = best.count;
  for (std::size_t i = 0; i < best.count; ++i) {
    s.vertices[i] = all.vertices[best.of[i]];
    s.weights[i] = best.weights[i];
  }
  v = best.v;
  return true;
}

bool has(const Simplex& s, const Vec3& w) noexcept {
  return std::any_of(s.vertices.begin(), s.vertices.begin() + static_cast<std::ptrdiff_t>(s.count),
                     [&](const Vertex& one) { return one.w == w; });
}

/// The point of B - A farthest against v.
Vertex supportAgainst(const PlacedSupport& A, const PlacedSupport& B, const Vec3& v, DistanceMemory& memory) noexcept {
  Vertex vertex;
  vertex.on_a = A.R * A.support(A.R.transpose() * v, memory.a) + A.p;
  vertex.on_b = B.R * B.support(B.R.transpose() * -v, memory.b) + B.p;
  vertex.w = vertex.on_b - vertex.on_a;
  return vertex;
}

}  // namespace

namespace {

/// Without the vertices that no face has, such as those within merged triangles: a search along the edges would begin there
/// and not get away.
Hull withoutLoosePoints(Hull hull) {
  if (hull.faces.empty()) return hull;
  std::vector<std::int32_t> place(hull.vertices.size(), -1);
  std::vector<Vec3> kept;
  for (Hull::Face& face : hull.faces) {
    for (std::int32_t& v : face.loop) {
      if (place[index(v)] < 0) {
        place[index(v)] = static_cast<std::int32_t>(kept.size());
        kept.push_back(hull.vertices[index(v)]);
      }
      v = place[index(v)];
    }
  }
  for (Hull::Edge& edge : hull.edges) {
    edge.from = place[index(edge.from)];
    edge.to = place[index(edge.to)];
  }
  hull.vertices = std::move(kept);
  return hull;
}

}  // namespace

SupportOf::SupportOf(Hull hull) : hull_(withoutLoosePoints(std::move(hull))) {
  if (hull_.cylinder || hull_.vertices.size() <= kSearchedVertices) return;
  first_.assign(hull_.vertices.size() + 1, 0);
  for (const Hull::Edge& edge : hull_.edges) {
    ++first_[index(edge.from) + 1];
    ++first_[index(edge.to) + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  neighbours_.resize(2 * hull_.edges.size());
  std::vector<std::int32_t> next = first_;
  for (const Hull::Edge& edge : hull_.edges) {
    neighbours_[index(next[index(edge.from)]++)] = edge.to;
    neighbours_[index(next[index(edge.to)]++)] = edge.from;
  }
}

Vec3 SupportOf::operator()(const Vec3& d, std::int32_t& near) const noexcept {
  if (hull_.cylinder) {
    const double across = std::hypot(d.x(), d.y()), out = across > 0 ? hull_.cylinder->radius / across : 0;
    return {out * d.x(), out * d.y(), std::copysign(hull_.cylinder->length / 2, d.z())};
  }
  if (neighbours_.empty()) {
    double farthest = -1e300;
    for (std::size_t i = 0; i < hull_.vertices.size(); ++i) {
      const double along = d.dot(hull_.vertices[i]);
      if (along <= farthest) continue;
      farthest = along;
      near = static_cast<std::int32_t>(i);
    }
    return hull_.vertices[index(near)];
  }
  // uphill along the edges: on a convex solid the top is the farthest of all
  std::int32_t at = near;
  double farthest = d.dot(hull_.vertices[index(at)]);
  for (bool climbs = true; climbs;) {
    climbs = false;
    for (std::int32_t n = first_[index(at)]; n < first_[index(at) + 1]; ++n) {
      const std::int32_t to = neighbours_[index(n)];
      const double along = d.dot(hull_.vertices[index(to)]);
      if (along <= farthest) continue;
      farthest = along;
      near = to;
      climbs = true;
    }
    at = near;
  }
  return hull_.vertices[index(at)];
}

SupportingPlane planeAlong(const PlacedSupport& A, const PlacedSupport& B, const Vec3& nhat_AB,
                           DistanceMemory& memory) noexcept {
  const Vertex vertex = supportAgainst(A, B, nhat_AB, memory);
  const Vec3 on_a = vertex.on_a + A.support.hull().radius * nhat_AB,
             on_b = vertex.on_b - B.support.hull().radius * nhat_AB;
  return {nhat_AB, nhat_AB.dot(on_b - on_a), on_a, on_b};
}

SupportingPlane planeOfFaces(const PlacedSupport& A, const PlacedSupport& B, DistanceMemory& memory) noexcept {
  const Vec3 way = B.R * B.support.hull().centre + B.p - A.R * A.support.hull().centre - A.p;
  SupportingPlane best = planeAlong(A, B, way.norm() > 0 ? Vec3(way.normalized()) : Vec3(Vec3::UnitZ()), memory);
  const auto consider = [&](const Vec3& nhat_AB) {
    const SupportingPlane plane = planeAlong(A, B, nhat_AB, memory);
    if (plane.gap > best.gap) best = plane;
  };
  for (const Hull::Face& face : A.support.hull().faces) consider(A.R * face.nhat);
  for (const Hull::Face& face : B.support.hull().faces) consider(B.R * -face.nhat);
  return best;
}

ConvexDistance distance(const PlacedSupport& A, const PlacedSupport& B, double beyond,
                        DistanceMemory& memory) noexcept {
  const double radii = A.support.hull().radius + B.support.hull().radius;
  const Vec3 towards = memory.nhat_AB.isZero() ? Vec3(B.p - A.p) : memory.nhat_AB;
  Simplex simplex;
  Vec3 v = towards.isZero() ? Vec3(Vec3::UnitZ()) : towards;
  double scale = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Vertex vertex = supportAgainst(A, B, v, memory);
    scale = std::max(scale, vertex.w.squaredNorm());
    const double bound = v.dot(vertex.w), length = v.norm();  // all of B - A lies beyond bound / length along v
    if (bound > (beyond + radii) * length) {
      const Vec3 nhat = memory.nhat_AB = v / length;
      return {ConvexDistance::Kind::kBeyond, nhat, bound / length - radii, vertex.on_a + A.support.hull().radius * nhat,
              vertex.on_b - B.support.hull().radius * nhat};
    }
    if (simplex.count > 0 && (length * length - bound <= kConverged * length * length || has(simplex, vertex.w))) break;
    const Simplex before = simplex;
    const Vec3 v_before = v;
    simplex.vertices[simplex.count++] = vertex;
    if (!reduce(simplex, v)) return {};
    if (v.squaredNorm() <= kTouching * kTouching * scale) return {};
    if (before.count > 0 && v.squaredNorm() >= v_before.squaredNorm()) {  // rounding: no nearer
      simplex = before;
      v = v_before;
      break;
    }
  }
  ConvexDistance result{ConvexDistance::Kind::kNearest, v.normalized(), v.norm() - radii};
  for (std::size_t i = 0; i < simplex.count; ++i) {
    result.on_a += simplex.weights[i] * simplex.vertices[i].on_a;
    result.on_b += simplex.weights[i] * simplex.vertices[i].on_b;
  }
  result.on_a += A.support.hull().radius * result.nhat_AB;
  result.on_b -= B.support.hull().radius * result.nhat_AB;
  memory.nhat_AB = result.nhat_AB;
  return result;
}

}  // namespace presa
