#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// A body near one finger. Of a mesh: the cut, nodes of its hierarchy (MeshTree) that together hold every triangle within
/// `radius` of `center_B`. A haptic tick starts from the cut while what it looks at lies in that ball, else from the root: it
/// never lacks a triangle.
struct NearBody {
  std::int32_t body = kNoBody;
  std::int32_t cut_count = 0;    ///< 0: a primitive, or no cut
  Vec3 center_B = Vec3::Zero();  ///< [m]
  double radius = 0;             ///< [m]
  std::array<std::int32_t, kMaxCutNodes> cut;
};

/// What one finger can reach before the next query: a body that is not listed stays out of its reach as long as everything that
/// the finger looks at lies within `radius` of `center_W`.
struct FingerPatch {
  std::uint64_t serial = 0;  ///< of the query that made it: equal serials mean equal patches
  Vec3 center_W = Vec3::Zero();
  double radius = -1;  ///< [m]; negative: the list is of no use, every body has to be looked at
  std::int32_t body_count = 0;
  std::array<NearBody, kMaxNearBodies> bodies;
};

/// Bodies near every finger, and where to begin on their meshes. Written by: collision thread.
struct ContactPatches {
  double time = 0;         ///< simulated time of the query [s]
  std::int32_t count = 0;  ///< fingers
  std::array<FingerPatch, kMaxFingers> fingers;

  ContactPatches() = default;
  ContactPatches(const ContactPatches& other) { *this = other; }
  /// Copies only what is in use, and what is not there yet.
  ContactPatches& operator=(const ContactPatches& other) {
    if (this == &other) return *this;
    time = other.time;
    count = other.count;
    for (std::size_t f = 0; f < static_cast<std::size_t>(count); ++f) {
      FingerPatch& mine = fingers[f];
      const FingerPatch& theirs = other.fingers[f];
      if (mine.serial == theirs.serial && theirs.serial != 0) continue;
      mine.serial = theirs.serial;
      mine.center_W = theirs.center_W;
      mine.radius = theirs.radius;
      mine.body_count = theirs.body_count;
      std::copy_n(theirs.bodies.begin(), theirs.body_count, mine.bodies.begin());
    }
    return *this;
  }
};

}  // namespace presa
