#include "modules/view_osg/crease_normals.h"

#include <cmath>

namespace presa::view {
namespace {

struct Face {
  Vec3 normal = Vec3::Zero();            ///< unit; zero for a face without area
  std::array<double, 3> angle{0, 0, 0};  ///< interior angle at each corner [rad]
};

Face faceOf(const TriMesh& mesh, const TriMesh::Triangle& triangle) {
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.vertices[static_cast<std::size_t>(triangle[i])];
  Face face;
  const Vec3 area = (p[1] - p[0]).cross(p[2] - p[0]);
  if (!(area.norm() > 0)) return face;
  face.normal = area.normalized();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
    face.angle[i] = std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return face;
}

struct Corner {
  std::size_t triangle;
  std::size_t side;
};

/// Corners grouped by vertex: those of vertex v are [first[v], first[v + 1]).
struct CornerTable {
  std::vector<std::size_t> first;
  std::vector<Corner> corners;

  explicit CornerTable(const TriMesh& mesh) : first(mesh.vertices.size() + 1, 0), corners(3 * mesh.triangles.size()) {
    for (const auto& triangle : mesh.triangles)
      for (const auto vertex : triangle) ++first[static_cast<std::size_t>(vertex) + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t s = 0; s < 3; ++s) corners[next[static_cast<std::size_t>(mesh.triangles[t][s])]++] = {t, s};
  }
};

/// The normal of a corner: of the triangles around its vertex that meet its own at less than the crease angle.
Eigen::Vector3f normalAt(const Corner& corner, std::size_t v, const std::vector<Face>& faces, const CornerTable& table,
                         double smooth_above) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t o = table.first[v]; o < table.first[v + 1]; ++o) {
    const Face& other = faces[table.corners[o].triangle];
    if (other.normal.dot(faces[corner.triangle].normal) > smooth_above)
      sum += other.angle[table.corners[o].side] * other.normal;
  }
  return sum.normalized().cast<float>();
}

std::vector<Face> facesOf(const TriMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) faces.push_back(faceOf(mesh, triangle));
  return faces;
}

}  // namespace

std::vector<Eigen::Vector3f> cornerNormals(const TriMesh& mesh, double crease_angle) {
  const std::vector<Face> faces = facesOf(mesh);
  const CornerTable table(mesh);
  std::vector<Eigen::Vector3f> normals(3 * mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (std::size_t c = table.first[v]; c < table.first[v + 1]; ++c) {
      const Corner& corner = table.corners[c];
      normals[3 * corner.triangle + corner.side] = normalAt(corner, v, faces, table, std::cos(crease_angle));
    }
  }
  return normals;
}

ShadedMesh shadeWithCreases(const TriMesh& mesh, double crease_angle) {
  const std::vector<Face> faces = facesOf(mesh);
  const CornerTable table(mesh);
  const double smooth_above = std::cos(crease_angle);
  ShadedMesh out;
  std::vector<std::array<std::uint32_t, 3>> index(mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const std::size_t begin = out.positions.size();
    for (std::size_t c = table.first[v]; c < table.first[v + 1]; ++c) {
      const Corner& corner = table.corners[c];
      const Eigen::Vector3f normal = normalAt(corner, v, faces, table, smooth_above);
      std::size_t at = begin;
      while (at < out.normals.size() && (out.normals[at] - normal).squaredNorm() > 1e-10F) ++at;
      if (at == out.normals.size()) {
        out.positions.push_back(mesh.vertices[v].cast<float>());
        out.normals.push_back(normal);
      }
      index[corner.triangle][corner.side] = static_cast<std::uint32_t>(at);
    }
  }
  for (std::size_t t = 0; t < index.size(); ++t)
    if (!faces[t].normal.isZero(0)) out.indices.insert(out.indices.end(), index[t].begin(), index[t].end());
  return out;
}

}  // namespace presa::view
