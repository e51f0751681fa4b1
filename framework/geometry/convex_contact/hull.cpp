#include "framework/geometry/convex_contact/hull.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/geometry/index.h"

namespace presa {
namespace {

constexpr double kSameLine = 1e-9;  // 1 - |cosine| of parallel edges

std::int32_t directionOf(Hull& hull, const Vec3& along) {
  const Vec3 d = along.normalized();
  for (std::size_t i = 0; i < hull.directions.size(); ++i) {
    if (std::abs(hull.directions[i].dot(d)) > 1 - kSameLine) return static_cast<std::int32_t>(i);
  }
  hull.directions.push_back(d);
  return static_cast<std::int32_t>(hull.directions.size() - 1);
}

/// Fills edges and directions from the loops of the faces. False when an edge has not exactly two faces.
bool joinFaces(Hull& hull) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> half;  // directed edge: its face
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const std::vector<std::int32_t>& loop = hull.faces[f].loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (!half.emplace(std::pair{loop[i], loop[(i + 1) % loop.size()]}, static_cast<std::int32_t>(f)).second)
        return false;
    }
  }
  for (const auto& [ends, face] : half) {
    const auto other = half.find({ends.second, ends.first});
    if (other == half.end()) return false;
    if (ends.first > ends.second) continue;
    const Vec3 along = hull.vertices[index(ends.second)] - hull.vertices[index(ends.first)];
    hull.edges.push_back({ends.first, ends.second, face, other->second, directionOf(hull, along)});
  }
  return true;
}

/// The outline of triangles in one plane; empty when it is no single loop.
std::vector<std::int32_t> outlineOf(const TriMesh& mesh, const std::vector<std::size_t>& triangles) {
  std::map<std::int32_t, std::int32_t> next;
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (const std::size_t t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    if (edges.contains({edge.second, edge.first})) continue;
    if (!next.emplace(edge.first, edge.second).second) return {};
  }
  std::vector<std::int32_t> loop;
  if (next.empty()) return loop;
  for (std::int32_t at = next.begin()->first; loop.empty() || at != loop.front(); at = next.at(at)) {
    if (!next.contains(at) || loop.size() > next.size()) return {};
    loop.push_back(at);
  }
  return loop.size() == next.size() ? loop : std::vector<std::int32_t>{};
}

/// Removes corners on a straight line: the neighbour's outline has them too, so both faces lose them.
void dropStraightCorners(Hull& hull) {
  std::vector<int> faces_at(hull.vertices.size(), 0);
  for (const Hull::Face& face : hull.faces) {
    for (const std::int32_t v : face.loop) ++faces_at[index(v)];
  }
  for (Hull::Face& face : hull.faces) {
    std::erase_if(face.loop, [&](std::int32_t v) { return faces_at[index(v)] < 3; });
  }
}

}  // namespace

Hull polyhedron(const std::vector<Vec3>& corners, const std::vector<std::vector<std::int32_t>>& loops) {
  Hull hull;
  hull.vertices = corners;
  for (const std::vector<std::int32_t>& loop : loops) {
    const Vec3 &a = corners[index(loop[0])], &b = corners[index(loop[1])], &c = corners[index(loop[2])];
    const Vec3 nhat = (b - a).cross(c - b).normalized();
    hull.faces.push_back({nhat, nhat.dot(a), loop});
  }
  joinFaces(hull);
  for (const Vec3& v : corners) hull.centre += v / static_cast<double>(corners.size());
  return hull;
}

Hull boxHull(const Vec3& size) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(
        Vec3((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5).cwiseProduct(size));
  }
  return polyhedron(corners, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

Hull sphereHull(double radius) {
  Hull hull;
  hull.radius = radius;
  hull.vertices = {Vec3::Zero()};
  return hull;
}

Hull capsuleHull(double radius, double length) {
  Hull hull;
  hull.radius = radius;
  hull.vertices = {Vec3(0, 0, -length / 2), Vec3(0, 0, length / 2)};
  hull.edges = {{0, 1, -1, -1, 0}};
  hull.directions = {Vec3::UnitZ()};
  return hull;
}

std::optional<Hull> meshHull(const TriMesh& mesh, double tolerance, std::size_t max_faces) {
  if (mesh.vertices.size() < 4) return std::nullopt;
  const AxisBox bounds = boundsOf(mesh);
  const double size = (bounds.high - bounds.low).norm(), close = tolerance * size;
  Hull hull;
  hull.vertices = mesh.vertices;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corner = [&](std::size_t i) { return mesh.vertices[index(mesh.triangles[t][i])]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    if (!(normal.norm() > 1e-12 * size * size)) return std::nullopt;
    const Vec3 nhat = normal.normalized();
    const double offset = nhat.dot(corner(0));
    for (const Vec3& v : mesh.vertices) {
      if (nhat.dot(v) > offset + close) return std::nullopt;
    }
    const auto same = std::find_if(hull.faces.begin(), hull.faces.end(), [&](const Hull::Face& face) {
      return face.nhat.dot(nhat) > 1 - 1e-10 && std::abs(face.offset - offset) < close;
    });
    if (same == hull.faces.end()) {
      if (hull.faces.size() == max_faces) return std::nullopt;
      hull.faces.push_back({nhat, offset, {}});
      groups.push_back({t});
    } else {
      groups[static_cast<std::size_t>(same - hull.faces.begin())].push_back(t);
    }
  }
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    hull.faces[f].loop = outlineOf(mesh, groups[f]);
    if (hull.faces[f].loop.size() < 3) return std::nullopt;
  }
  dropStraightCorners(hull);
  if (!joinFaces(hull)) return std::nullopt;
  for (const Vec3& v : hull.vertices) hull.centre += v / static_cast<double>(hull.vertices.size());
  return hull;
}

void place(const Hull& hull, const Pose& X_WH, Hull& out) {
  const Mat3 R = X_WH.q.toRotationMatrix();
  out.radius = hull.radius;
  out.centre = R * hull.centre + X_WH.p;
  out.vertices.resize(hull.vertices.size());
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) out.vertices[i] = R * hull.vertices[i] + X_WH.p;
  out.directions.resize(hull.directions.size());
  for (std::size_t i = 0; i < hull.directions.size(); ++i) out.directions[i] = R * hull.directions[i];
  if (out.faces.size() != hull.faces.size()) out.faces = hull.faces;
  for (std::size_t i = 0; i < hull.faces.size(); ++i) {
    out.faces[i].nhat = R * hull.faces[i].nhat;
    out.faces[i].offset = hull.faces[i].offset + out.faces[i].nhat.dot(X_WH.p);
  }
  if (out.edges.size() != hull.edges.size()) out.edges = hull.edges;
}

}  // namespace presa
