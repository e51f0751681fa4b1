#pragma once
#include "framework/geometry/mesh_tree.h"

namespace presa {

/// The way of a probe, from its last position to the present one, enlarged by what it can reach: all points within
/// `radius` of the segment. One frame, any [m]. from == to is a ball.
struct ProbeWay {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double radius = 0;

  /// Distance of a point from the segment [m].
  double distanceOf(const Vec3& p) const noexcept;
  /// Whether an oriented box, axes as columns, may reach into the capsule. Errs towards true, also for NaN.
  bool mayTouch(const Mat3& axes, const Vec3& center, const Vec3& half) const noexcept;
  /// Whether the whole box lies in the capsule. Errs towards false, also for NaN.
  bool holds(const Vec3& center, const Vec3& half) const noexcept;
};

/// Distance between the capsule's segment and triangle (a, b, c), which may have no area [m]. [Ericson2004 5.1]
double distance(const ProbeWay& way, const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

/// Whether a facet of the mesh is within the capsule's radius of its segment.
bool reaches(const ProbeWay& way, const MeshTree& mesh, std::int32_t facet) noexcept;

}  // namespace presa
