#include "framework/geometry/mesh_distance.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/closest_point.h"

namespace presa {
namespace {

constexpr double kOnFeature = 1e-9;  // relative to the longest edge: nearer than this to an edge or corner is on it

double angleAt(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  return std::atan2(ab.cross(ac).norm(), ab.dot(ac));
}

}  // namespace

MeshDistance::MeshDistance(const TriMesh& mesh)
    : mesh_(mesh),
      tree_(mesh),
      face_normal_(mesh.triangles.size(), Vec3::Zero()),
      vertex_normal_(mesh.vertices.size(), Vec3::Zero()) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vec3, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) corner[i] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][i])];
    face_normal_[t] = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = angleAt(corner[i], corner[(i + 1) % 3], corner[(i + 2) % 3]);
      vertex_normal_[static_cast<std::size_t>(mesh.triangles[t][i])] += angle * face_normal_[t];
    }
  }
}

double MeshDistance::operator()(const Vec3& p, double bound) const {
  std::size_t t = tree_.nearest(p, bound * bound);
  const TriMesh::Triangle& triangle = mesh_.triangles[t];
  std::array<Vec3, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) corner[i] = mesh_.vertices[static_cast<std::size_t>(triangle[i])];
  const Vec3 nearest = closestOnTriangle(p, corner[0], corner[1], corner[2]);
  const double longest =
      std::max({(corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(), (corner[0] - corner[2]).norm()});
  Vec3 normal = face_normal_[t];
  for (std::size_t i = 0; i < 3; ++i) {
    if ((nearest - corner[i]).norm() <= kOnFeature * longest) {
      normal = vertex_normal_[static_cast<std::size_t>(triangle[i])];
      break;
    }
    const Vec3 along = closestOnSegment(nearest, corner[i], corner[(i + 1) % 3]);
    const std::int32_t other = mesh_.adjacency[t][i];
    const bool at_end = (nearest - corner[(i + 1) % 3]).norm() <= kOnFeature * longest;
    if (!at_end && other >= 0 && (nearest - along).norm() <= kOnFeature * longest)
      normal = face_normal_[t] + face_normal_[static_cast<std::size_t>(other)];
  }
  return std::copysign((p - nearest).norm(), (p - nearest).dot(normal));
}

}  // namespace presa
