#include "modules/view_osg/slice_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace presa::view {
namespace {

constexpr double kRoom = 0.6;         // around the tool, in radii of a ball around it
constexpr int kCells = 192;           // along the longer side
constexpr double kFlat = 0.7;         // a third side below this share of the second makes a tool flat,
constexpr double kRound = 0.7;        // unless the second is below this share of the first
constexpr double kAlongSight = 0.05;  // sine of the angle to the line of sight below which an axis has no facing plane

/// Axes of a box, from the longest side to the shortest.
std::array<Eigen::Index, 3> sidesOf(const Vec3& half) {
  std::array<Eigen::Index, 3> axis{2, 0, 1};  // equal sides: upright
  std::ranges::stable_sort(axis, [&](Eigen::Index a, Eigen::Index b) { return half[a] > half[b] * 1.001; });
  return axis;
}

}  // namespace

SlicePlane planeThrough(const AxisBox& tool_T, const Pose& X_WT, const Vec3& eye_W) {
  const Vec3 half = (tool_T.high - tool_T.low) / 2, middle_W = X_WT * Vec3((tool_T.high + tool_T.low) / 2);
  const auto [first, second, third] = sidesOf(half);
  const Mat3 R_WT = X_WT.q.toRotationMatrix();
  const Vec3 sight = (eye_W - middle_W).normalized(), along = R_WT.col(first);
  const bool flat = half[third] < kFlat * half[second] && half[second] > kRound * half[first];
  Vec3 normal = flat ? Vec3(R_WT.col(third)) : Vec3(sight - sight.dot(along) * along);
  if (normal.norm() < kAlongSight) normal = R_WT.col(third);
  if (normal.dot(sight) < 0) normal = -normal;
  normal.normalize();
  Mat3 R_WS;
  R_WS << along, normal.cross(along), normal;
  const double room = kRoom * half.norm();
  const Vec3 across = (R_WT.transpose() * R_WS.col(1)).cwiseAbs();
  return {{middle_W, Quat(R_WS)}, half[first] + room, across.dot(half) + room};
}

SliceGrid distancesOn(const SlicePlane& plane, const std::vector<ToolField>& fields, const std::vector<Pose>& X_WB,
                      const std::vector<double>& radius, double range) {
  const double cell = 2 * std::max(plane.half_x, plane.half_y) / kCells;
  SliceGrid grid{.columns = std::max(2, static_cast<int>(std::round(2 * plane.half_x / cell)) + 1),
                 .rows = std::max(2, static_cast<int>(std::round(2 * plane.half_y / cell)) + 1)};
  grid.values.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                     static_cast<float>(2 * range));
  const double step_x = 2 * plane.half_x / (grid.columns - 1), step_y = 2 * plane.half_y / (grid.rows - 1);
  for (const ToolField& field : fields) {
    const auto body = static_cast<std::size_t>(field.body);
    if (body >= X_WB.size() || body >= radius.size()) continue;
    const double reach = std::hypot(plane.half_x, plane.half_y) + radius[body] + range;
    if ((X_WB[body].p - plane.X_WS.p).norm() > reach) continue;
    const Pose X_BS = X_WB[body].inverse() * plane.X_WS;
    const Mat3 R_BS = X_BS.q.toRotationMatrix();
    float* value = grid.values.data();
    for (int j = 0; j < grid.rows; ++j) {
      const Vec3 row = X_BS.p + (j * step_y - plane.half_y) * R_BS.col(1);
      for (int i = 0; i < grid.columns; ++i, ++value)
        *value = std::min(*value, static_cast<float>(field.distance(row + (i * step_x - plane.half_x) * R_BS.col(0))));
    }
  }
  return grid;
}

std::vector<Vec3> outlineOn(const SlicePlane& plane, const TriMesh& mesh, const Pose& X_WT) {
  const Pose X_ST = plane.X_WS.inverse() * X_WT;
  std::vector<Vec3> corners, ends;
  corners.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) corners.push_back(X_ST * vertex);
  for (const TriMesh::Triangle& triangle : mesh.triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      const Vec3 &a = corners[static_cast<std::size_t>(triangle[e])],
                 &b = corners[static_cast<std::size_t>(triangle[(e + 1) % 3])];
      // a corner on the plane counts as above: two sides of a triangle cross, or none
      if ((a.z() < 0) != (b.z() < 0)) ends.push_back(a + a.z() / (a.z() - b.z()) * (b - a));
    }
  }
  return ends;
}

}  // namespace presa::view
