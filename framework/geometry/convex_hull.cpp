#include <algorithm>
#include <cmath>
#include <map>

#include "framework/geometry/convex.h"

namespace presa {
namespace {

// in relation to the size of the points
constexpr double kOutside = 1e-7;   // a point nearer than this to the hull adds nothing to it
constexpr double kVisible = 1e-11;  // a face is seen from a point this far in front of it
constexpr double kBulge = 1e-5;
constexpr double kFlatHull = 1e-9;  // volume of the first tetrahedron

struct HullFace {
  std::array<std::int32_t, 3> corners;
  std::array<std::int32_t, 3> next;  // face across the edge from corner i to i + 1
  Vec3 nhat;
  double offset;
  std::vector<std::int32_t> outside;  // points in front of it
  std::int32_t farthest = -1;
  double distance = 0;
  bool gone = false;
};

class HullMaker {
 public:
  HullMaker(const std::vector<Vec3>& points, double size) : points_(points), size_(size) {}

  bool begin();
  void grow(std::size_t max_vertices);
  /// With these points in place of those it was made of.
  TriMesh mesh(const std::vector<Vec3>& points) const;

 private:
  const Vec3& at(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }
  HullFace& face(std::int32_t f) { return faces_[static_cast<std::size_t>(f)]; }
  std::int32_t addFace(std::int32_t a, std::int32_t b, std::int32_t c);
  void give(std::int32_t p, std::int32_t from, std::int32_t to);
  void addPoint(std::int32_t p, std::int32_t seen_from);

  const std::vector<Vec3>& points_;
  const double size_;
  std::vector<HullFace> faces_;
};

std::int32_t HullMaker::addFace(std::int32_t a, std::int32_t b, std::int32_t c) {
  const Vec3 nhat = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
  faces_.push_back({{a, b, c}, {-1, -1, -1}, nhat, nhat.dot(at(a)), {}});
  return static_cast<std::int32_t>(faces_.size() - 1);
}

/// Gives point p to the first of the faces in [from, to) that it is in front of.
void HullMaker::give(std::int32_t p, std::int32_t from, std::int32_t to) {
  for (std::int32_t f = from; f < to; ++f) {
    const double distance = face(f).nhat.dot(at(p)) - face(f).offset;
    if (!(distance > kOutside * size_)) continue;
    face(f).outside.push_back(p);
    if (distance <= face(f).distance) return;
    face(f).distance = distance;
    face(f).farthest = p;
    return;
  }
}

/// The first tetrahedron: of points far apart. False when all lie in a plane.
bool HullMaker::begin() {
  const auto count = static_cast<std::int32_t>(points_.size());
  const auto farthest = [&](auto measure) {
    std::int32_t best = 0;
    for (std::int32_t i = 1; i < count; ++i) {
      if (measure(at(i)) > measure(at(best))) best = i;
    }
    return best;
  };
  const std::int32_t a = farthest([](const Vec3& p) { return -p.x(); });
  const std::int32_t b = farthest([&](const Vec3& p) { return (p - at(a)).squaredNorm(); });
  const Vec3 along = at(b) - at(a);
  std::int32_t c = farthest([&](const Vec3& p) { return along.cross(p - at(a)).squaredNorm(); });
  const Vec3 normal = along.cross(at(c) - at(a));
  const std::int32_t d = farthest([&](const Vec3& p) { return std::abs(normal.dot(p - at(a))); });
  const double volume = normal.dot(at(d) - at(a));
  if (!(std::abs(volume) > kFlatHull * size_ * size_ * size_)) return false;
  std::int32_t first = b;
  if (volume > 0) std::swap(first, c);
  const std::array<std::array<std::int32_t, 3>, 4> faces{{{a, first, c}, {a, d, first}, {first, d, c}, {c, d, a}}};
  for (const auto& [i, j, k] : faces) addFace(i, j, k);
  for (HullFace& one : faces_) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::int32_t g = 0; g < 4; ++g) {
        for (std::size_t j = 0; j < 3; ++j) {
          const HullFace& other = face(g);
          if (other.corners[j] == one.corners[(i + 1) % 3] && other.corners[(j + 1) % 3] == one.corners[i])
            one.next[i] = g;
        }
      }
    }
  }
  for (std::int32_t p = 0; p < count; ++p) give(p, 0, 4);
  return true;
}

void HullMaker::addPoint(std::int32_t p, std::int32_t seen_from) {
  std::vector<std::int32_t> seen{seen_from}, orphans;
  face(seen_from).gone = true;
  struct Rim {
    std::int32_t from, to, beyond;
  };
  std::map<std::int32_t, Rim> rim;  // by its first corner
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::int32_t next = face(seen[i]).next[e];
      if (face(next).gone) continue;
      if (face(next).nhat.dot(at(p)) - face(next).offset > kVisible * size_) {
        face(next).gone = true;
        seen.push_back(next);
      }
    }
  }
  for (const std::int32_t f : seen) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::int32_t next = face(f).next[e];
      if (face(next).gone) continue;
      rim[face(f).corners[e]] = {face(f).corners[e], face(f).corners[(e + 1) % 3], next};
    }
    orphans.insert(orphans.end(), face(f).outside.begin(), face(f).outside.end());
    face(f).outside.clear();
  }
  const auto first = static_cast<std::int32_t>(faces_.size());
  std::map<std::int32_t, std::int32_t> made;  // by first corner of the rim's edge
  for (const auto& [from, edge] : rim) made[from] = addFace(edge.from, edge.to, p);
  for (const auto& [from, edge] : rim) {
    HullFace& one = face(made[from]);
    one.next[0] = edge.beyond;
    one.next[1] = made.contains(edge.to) ? made[edge.to] : made[from];
    face(one.next[1]).next[2] = made[from];
    HullFace& beyond = face(edge.beyond);
    for (std::size_t e = 0; e < 3; ++e) {
      if (beyond.corners[e] == edge.to && beyond.corners[(e + 1) % 3] == edge.from) beyond.next[e] = made[from];
    }
  }
  for (const std::int32_t orphan : orphans) {
    if (orphan != p) give(orphan, first, static_cast<std::int32_t>(faces_.size()));
  }
}

void HullMaker::grow(std::size_t max_vertices) {
  for (std::size_t vertices = 4; vertices < max_vertices; ++vertices) {
    std::int32_t best = -1;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(faces_.size()); ++f) {
      if (face(f).gone || face(f).farthest < 0) continue;
      if (best < 0 || face(f).distance > face(best).distance) best = f;
    }
    if (best < 0) return;
    addPoint(face(best).farthest, best);
  }
}

TriMesh HullMaker::mesh(const std::vector<Vec3>& points) const {
  TriMesh mesh;
  mesh.vertices = points;
  for (const HullFace& one : faces_) {
    if (!one.gone) mesh.triangles.push_back(one.corners);
  }
  dropUnused(mesh);
  buildAdjacency(mesh);
  return mesh;
}

}  // namespace

std::optional<TriMesh> convexHull(const std::vector<Vec3>& points, std::size_t max_vertices) {
  if (points.size() < 4) return std::nullopt;
  TriMesh cloud;
  cloud.vertices = points;
  const AxisBox bounds = boundsOf(cloud);
  const double size = (bounds.high - bounds.low).norm();
  // points within edges and faces, of which a cut solid has many, sink in by this and are no corners then
  const Vec3 centre = (bounds.low + bounds.high) / 2;
  std::vector<Vec3> bulged;
  for (const Vec3& p : points) bulged.push_back(p + kBulge * (p - centre).squaredNorm() / (size * size) * (p - centre));
  HullMaker maker(bulged, size);
  if (!maker.begin()) return std::nullopt;
  maker.grow(max_vertices);
  return maker.mesh(points);
}

bool isConvex(const TriMesh& mesh, double tolerance) {
  const AxisBox bounds = boundsOf(mesh);
  const double close = tolerance * (bounds.high - bounds.low).norm();
  for (const TriMesh::Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    const Vec3 nhat = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    const double offset = nhat.dot(corner(0));
    for (const Vec3& v : mesh.vertices) {
      if (nhat.dot(v) > offset + close) return false;
    }
  }
  return true;
}

}  // namespace presa
