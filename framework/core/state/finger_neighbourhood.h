#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// A body near one finger. A mesh has a cut: nodes of its MeshTree that together hold every triangle within `radius` of
/// `center_B`. A haptic tick starts its query at the cut while the query stays within that ball, else at the root, so
/// that it never misses a triangle.
struct NearBody {
  std::int32_t body = kNoBody;                 ///< index into Scene::bodies
  std::int32_t cut_count = 0;                  ///< 0: a primitive, or no cut
  Vec3 center_B = Vec3::Zero();                ///< in coordinates of `body` [m]
  double radius = 0;                           ///< [m]
  std::array<std::int32_t, kMaxCutNodes> cut;  ///< node indices; the first cut_count are set
};

/// The bodies that one finger can reach before the next query. The list is complete as long as the finger's query stays
/// within `radius` of `center_W`.
struct FingerNeighbourhood {
  std::uint64_t serial = 0;      ///< number of the query that made it: equal serials mean equal neighbourhoods
  Vec3 center_W = Vec3::Zero();  ///< [m]
  double radius = -1;            ///< [m]; negative: the list is not usable, every body has to be tested
  std::int32_t body_count = 0;   ///< bodies in use
  std::array<NearBody, kMaxNearBodies> bodies;  ///< the first body_count are set
};

/// Bodies near every finger, and the nodes at which to start in their meshes. The collision query sizes it by the
/// scene's devices at load, one finger each; its length then stays constant. Written by: collision thread.
struct FingerNeighbourhoods {
  double time = 0;                           ///< simulated time of the query [s]
  std::int32_t count = 0;                    ///< fingers in use, 0 <= count <= fingers.size()
  std::vector<FingerNeighbourhood> fingers;  ///< in the order of the scene's devices

  FingerNeighbourhoods() = default;                                           ///< of no finger
  FingerNeighbourhoods(const FingerNeighbourhoods& other) { *this = other; }  ///< as by assignment
  /// Copies only the fingers in use, and only neighbourhoods whose serial differs. Allocates only when the lengths
  /// differ.
  FingerNeighbourhoods& operator=(const FingerNeighbourhoods& other) {
    if (this == &other) return *this;
    time = other.time;
    count = other.count;
    if (fingers.size() != other.fingers.size()) fingers.resize(other.fingers.size());
    for (std::size_t f = 0; f < static_cast<std::size_t>(count); ++f) {
      FingerNeighbourhood& mine = fingers[f];
      const FingerNeighbourhood& theirs = other.fingers[f];
      if (mine.serial == theirs.serial && theirs.serial != 0) continue;
      mine.serial = theirs.serial;
      mine.center_W = theirs.center_W;
      mine.radius = theirs.radius;
      mine.body_count = theirs.body_count;
      std::copy_n(theirs.bodies.begin(), theirs.body_count, mine.bodies.begin());
    }
    return *this;
  }

  /// Heap memory that it owns [bytes] (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return fingers.capacity() * sizeof(FingerNeighbourhood); }
};

}  // namespace presa
