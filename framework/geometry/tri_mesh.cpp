#include "framework/geometry/tri_mesh.h"

#include <algorithm>
#include <utility>

namespace presa {
namespace {

const Vec3& corner(const TriMesh& mesh, const TriMesh::Triangle& triangle, std::size_t i) {
  return mesh.vertices[static_cast<std::size_t>(triangle[i])];
}

}  // namespace

AxisBox boundsOf(const TriMesh& mesh) {
  AxisBox box;
  for (const Vec3& vertex : mesh.vertices) {
    box.low = box.low.cwiseMin(vertex);
    box.high = box.high.cwiseMax(vertex);
  }
  return box;
}

double radiusOf(const TriMesh& mesh) {
  double radius = 0;
  for (const Vec3& vertex : mesh.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}

MassProperties massProperties(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  // Sum of signed tetrahedra over the triangles. The apex in the middle of the mesh keeps cancellation small even when
  // the mesh lies far from the origin.
  const AxisBox box = boundsOf(mesh);
  const Vec3 apex = 0.5 * (box.low + box.high);
  double volume6 = 0;             // 6 V
  Vec3 moment24 = Vec3::Zero();   // 24 * integral of x
  Mat3 second120 = Mat3::Zero();  // 120 * integral of x x^T
  for (const TriMesh::Triangle& triangle : mesh.triangles) {
    const Vec3 a = corner(mesh, triangle, 0) - apex;
    const Vec3 b = corner(mesh, triangle, 1) - apex;
    const Vec3 c = corner(mesh, triangle, 2) - apex;
    const double det = a.dot(b.cross(c));
    const Vec3 sum = a + b + c;
    volume6 += det;
    moment24 += det * sum;
    second120 += det * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  MassProperties result;
  result.volume = volume6 / 6;
  if (volume6 == 0) {
    result.center = apex;
    return result;
  }
  const Vec3 offset = moment24 / (4 * volume6);
  const Mat3 second = second120 / 120 - result.volume * offset * offset.transpose();
  result.center = apex + offset;
  result.inertia = second.trace() * Mat3::Identity() - second;
  return result;
}

void turnInsideOut(TriMesh& mesh) {
  for (TriMesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  // corners (a, b, c) became (a, c, b): edges ab, bc, ca are now edges 2, 1, 0
  for (TriMesh::Triangle& neighbours : mesh.adjacency) std::swap(neighbours[0], neighbours[2]);
}

}  // namespace presa
