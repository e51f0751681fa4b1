#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "framework/math/spatial.h"
#include "framework/state/limits.h"

namespace presa {

/// One triangle of a patch, in coordinates of its body.
struct PatchTriangle {
  std::array<Vec3, 3> v_B;                ///< corners, counter-clockwise seen from outside [m]
  std::int32_t id = -1;                   ///< index in the body's haptic mesh
  std::array<std::int32_t, 3> neighbour;  ///< mesh index of the triangle across edge (v[i], v[i+1]); -1: none
};

/// Sphere around a triangle [m].
struct BoundingSphere {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};
inline BoundingSphere boundOf(const std::array<Vec3, 3>& v) {
  const Vec3 center = (v[0] + v[1] + v[2]) / 3;
  const double squared =
      std::max({(v[0] - center).squaredNorm(), (v[1] - center).squaredNorm(), (v[2] - center).squaredNorm()});
  return {center, std::sqrt(squared) * (1 + 1e-12)};  // no corner outside by rounding
}

/// The part of one body's haptic mesh that lies within `radius` of `center_B`. It holds *every*
/// triangle that close unless `capped`; then `radius` has been shrunk to what is complete.
struct BodyPatch {
  std::int32_t body = kNoBody;
  std::int32_t first = 0;  ///< range in FingerPatch::triangles
  std::int32_t count = 0;
  Vec3 center_B = Vec3::Zero();  ///< [m]
  double radius = 0;             ///< [m]
  bool capped = false;
};

struct FingerPatch {
  std::uint64_t serial = 0;  ///< of the query that made it: equal serials mean equal patches
  std::int32_t body_count = 0;
  std::int32_t triangle_count = 0;
  std::array<BodyPatch, kMaxNearBodies> bodies;
  std::array<PatchTriangle, kMaxPatchTriangles> triangles;
  std::array<BoundingSphere, kMaxPatchTriangles> bounds;  ///< of each triangle, body coordinates
};

/// Local geometry around every finger. A mesh body that is not listed for a finger has nothing in reach.
/// Written by: collision thread.
struct ContactPatches {
  double time = 0;                 ///< simulated time of the query [s]
  std::int32_t count = 0;          ///< fingers
  std::uint64_t capped_total = 0;  ///< patches cut short since the start
  std::array<FingerPatch, kMaxFingers> fingers;

  ContactPatches() = default;
  ContactPatches(const ContactPatches& other) { *this = other; }
  /// Copies only what is in use, and what is not there yet.
  ContactPatches& operator=(const ContactPatches& other) {
    if (this == &other) return *this;
    time = other.time;
    count = other.count;
    capped_total = other.capped_total;
    for (std::size_t f = 0; f < static_cast<std::size_t>(count); ++f) {
      if (fingers[f].serial == other.fingers[f].serial && other.fingers[f].serial != 0) continue;
      fingers[f].serial = other.fingers[f].serial;
      fingers[f].body_count = other.fingers[f].body_count;
      fingers[f].triangle_count = other.fingers[f].triangle_count;
      std::copy_n(other.fingers[f].bodies.begin(), other.fingers[f].body_count, fingers[f].bodies.begin());
      std::copy_n(other.fingers[f].triangles.begin(), other.fingers[f].triangle_count, fingers[f].triangles.begin());
      std::copy_n(other.fingers[f].bounds.begin(), other.fingers[f].triangle_count, fingers[f].bounds.begin());
    }
    return *this;
  }
};

}  // namespace presa
