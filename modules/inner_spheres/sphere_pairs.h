#pragma once
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/virtual_coupling.h"
#include "modules/inner_spheres/sphere_tree.h"

namespace presa {

/// A body as inner spheres.
struct SphereSolid {
  std::int32_t body = kNoBody;  ///< index into Scene::bodies
  SphereTree tree;              ///< in body coordinates
};

/// Two spheres that may overlap in this tick.
struct SpherePair {
  Vec3 tool_T = Vec3::Zero(), body_W = Vec3::Zero();  ///< centres [m]
  double tool_radius = 0, body_radius = 0;            ///< [m]
  std::uint32_t solid = 0;                            ///< index of the body
  // at the last evaluation
  Vec3 p = Vec3::Zero();    ///< middle of the overlap, from the tool's origin, along the world's axes [m]
  Vec3 f_W = Vec3::Zero();  ///< on the tool [N]
};

/// The spheres of one tool against those of all bodies. Thread: haptic; nonblocking except for construction.
class SpherePairs {
 public:
  /// All must outlive it. `stiffness`: force over volume [N/m^3].
  SpherePairs(const SphereTree& tool, const std::vector<SphereSolid>& solids, double stiffness, std::size_t room)
      : tool_(tool), solids_(solids), stiffness_(stiffness), pairs_(room), stack_(kMaxStack) {}

  /// Lists the pairs that overlap, or can after a motion of the tool by `margin` [m]. `X_WB`: by solid. False: there was
  /// no room for some.
  bool gather(const Pose& X_WT, const std::vector<Pose>& X_WB, double margin) noexcept;
  /// Distance of the spheres around tool and bodies: a lower bound of their clearance [m].
  double clearance(const Pose& X_WT, const std::vector<Pose>& X_WB) const noexcept;
  /// Forces at a pose: the wrench on the tool about its origin, whose resistance to motion it adds to `stiffness`.
  Vec6 evaluate(const Pose& X_WT, Mat6& stiffness) noexcept;
  const BoundedList<SpherePair>& pairs() const noexcept { return pairs_; }  ///< at the last evaluation

 private:
  static constexpr std::size_t kMaxStack = 256;
  struct Two {
    std::int32_t tool, body;
  };
  void gatherFrom(std::uint32_t solid, const Pose& X_WT, const Pose& X_WB, double margin) noexcept;

  const SphereTree& tool_;
  const std::vector<SphereSolid>& solids_;
  double stiffness_;
  BoundedList<SpherePair> pairs_;
  BoundedList<Two> stack_;
};

}  // namespace presa
