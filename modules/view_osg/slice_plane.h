#pragma once
#include <vector>

#include "framework/geometry/tri_mesh.h"
#include "framework/haptics/tool_field.h"

/// A plane through a tool, and the signed distances on it. No drawing here.
namespace presa::view {

/// A rectangle of the plane z = 0 of its frame S, around S's origin.
struct SlicePlane {
  Pose X_WS;
  double half_x = 0, half_y = 0;  ///< [m]
};

/// The plane along the tool that faces the eye, with some room around the tool: it contains the longest side of the tool's
/// box, or, where the tool is flat, its two longest ones.
SlicePlane planeThrough(const AxisBox& tool_T, const Pose& X_WT, const Vec3& eye_W);

/// Signed distances on a grid of points on the plane, as the tool's renderer looks them up: of the nearest body, and at most
/// twice the range of the colours.
struct SliceGrid {
  int columns = 0, rows = 0;    ///< along x and y
  std::vector<float> values{};  ///< row by row, from the corner with the smallest coordinates [m]
};
/// `X_WB`: poses in the order of Scene::bodies. Bodies whose ball, `radius` by body, lies too far away for any colour of a
/// scale of `range` [m] are left out.
SliceGrid distancesOn(const SlicePlane& plane, const std::vector<ToolField>& fields, const std::vector<Pose>& X_WB,
                      const std::vector<double>& radius, double range);

/// Where the plane cuts a mesh at X_WT: pairs of ends of segments, in S [m].
std::vector<Vec3> outlineOn(const SlicePlane& plane, const TriMesh& mesh, const Pose& X_WT);

}  // namespace presa::view
