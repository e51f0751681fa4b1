#pragma once
#include <vector>

#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa {

/// Penetration depth of two boxes by the separating axis test (15 axes): the min translation that separates them [m]; 0
/// when they do not overlap. Sizes are full edge lengths [m]. Exact for boxes [Gottschalk1996]; uses no physics engine.
double boxPenetration(const Vec3& size_A, const Pose& X_WA, const Vec3& size_B, const Pose& X_WB);

/// Overlap of every pair of box-shaped bodies of a scene, at least one of them free: the same measure for every engine.
class PenetrationCheck {
 public:
  explicit PenetrationCheck(const World& world);
  struct Result {
    double mean = 0;  ///< over the overlapping pairs [m]
    double max = 0;   ///< [m]
    std::size_t pairs = 0;
  };
  /// Number of box pairs that are not both fixed.
  std::size_t pairs() const noexcept;
  /// Evaluates the poses at the end of the step.
  Result measure(const ObjectState& objects) const;

 private:
  struct BoxBody {
    std::size_t body = 0;
    Vec3 size;
    Pose X_BG;
    bool fixed = false;
    double radius = 0;
  };
  std::vector<BoxBody> boxes_;
};

}  // namespace presa
