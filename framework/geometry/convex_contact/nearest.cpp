#include "framework/geometry/convex_contact/nearest.h"

#include <algorithm>

#include "framework/geometry/index.h"

namespace presa {

std::pair<Vec3, Vec3> nearestOf(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 u = a1 - a0, v = b1 - b0, w = a0 - b0;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
  double s = det > 1e-12 * uu * vv ? std::clamp((uv * v.dot(w) - vv * u.dot(w)) / det, 0.0, 1.0) : 0.5;
  const Vec3 on_b = closestOnSegment(a0 + s * u, b0, b1);
  return {closestOnSegment(on_b, a0, a1), on_b};
}

namespace {

Vec3 nearestOnFace(const Hull& hull, const Hull::Face& face, const Vec3& p) {
  const Vec3 on_plane = p - (face.nhat.dot(p) - face.offset) * face.nhat;
  Vec3 nearest = on_plane;
  double distance = 1e300;
  bool inside = true;
  for (std::size_t i = 0; i < face.loop.size(); ++i) {
    const Vec3 &a = hull.vertices[index(face.loop[i])],
               &b = hull.vertices[index(face.loop[(i + 1) % face.loop.size()])];
    if ((b - a).cross(face.nhat).dot(on_plane - a) <= 0) continue;
    inside = false;
    const Vec3 q = closestOnSegment(p, a, b);
    if ((q - p).squaredNorm() >= distance) continue;
    distance = (q - p).squaredNorm();
    nearest = q;
  }
  return inside ? on_plane : nearest;
}

}  // namespace

bool nearestOutside(const Hull& hull, const Hull& core, Vec3& on_hull, Vec3& on_core) {
  double best = 1e300;
  const auto offer = [&](const Vec3& a, const Vec3& b) {
    if ((a - b).squaredNorm() >= best) return;
    best = (a - b).squaredNorm();
    on_hull = a;
    on_core = b;
  };
  for (const Vec3& v : core.vertices) {
    for (const Hull::Face& face : hull.faces) {
      if (face.nhat.dot(v) > face.offset) offer(nearestOnFace(hull, face, v), v);
    }
  }
  if (core.vertices.size() == 2) {
    for (const Hull::Edge& edge : hull.edges) {
      const auto [a, b] =
          nearestOf(hull.vertices[index(edge.from)], hull.vertices[index(edge.to)], core.vertices[0], core.vertices[1]);
      offer(a, b);
    }
  }
  return best < 1e300 && best > 0;
}

}  // namespace presa
