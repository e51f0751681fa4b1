#pragma once
#include <vector>

#include "framework/haptics/convex_pairs.h"
#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/virtual_coupling.h"
#include "modules/xfca/friction_circle.h"

namespace presa {

/// The algorithm as printed, with its step towards the handle corrected: a surface-object and a god-object for each pair
/// of convex parts in contact, whose forces add up [Harwin & Barrow 2013, 4.1 and 4.2]. Kept for comparison. Thread:
/// haptic; nonblocking except for construction.
class PairObjects {
 public:
  /// How a tool's handle and friction act.
  struct Law {
    const ToolCoupling& coupling;  ///< of the handle
    double curvature;              ///< smallest radius of curvature of the two parts' Minkowski sum [m]
    double fraction;               ///< see heldByFriction
  };
  /// All must outlive it. `friction`: by body of `bodies`.
  PairObjects(ConvexPairs& pairs, const std::vector<ConvexSolid>& bodies,
              const std::vector<FrictionCoefficients>& friction, const Law& law)
      : pairs_(pairs), bodies_(bodies), friction_(friction), law_(law), contacts_(pairs.pairCount()) {}

  /// Adds the forces of all pairs in contact. `X_WH`: the handle. False: there were more pairs than can be listed.
  bool touch(const Pose& X_WH, const Touchables& touchables, BoundedList<ToolForce>& forces) noexcept;
  void letGo() noexcept;  ///< no pair is in contact

 private:
  struct Contact {
    bool touching = false, slipping = false;
    std::uint64_t tick = 0;                                   // of the last look
    double reach = 0;                                         // from the handle to the surface [m]
    Vec3 surface_B = Vec3::Zero(), god_B = Vec3::Zero();      // where the tool's origin would be and is [m]
    Vec3 nhat_B = Vec3::UnitZ(), god_nhat_B = Vec3::UnitZ();  // of their planes
  };
  static bool begin(const NearParts& pair, const Pose& X_WH, const Pose& X_WB, Contact& contact) noexcept;
  bool follow(NearParts& pair, const Pose& X_WH, const Pose& X_WB, Contact& contact) noexcept;
  /// Moves x along its plane to the point nearest to `goal`, back towards the handle, and out to the surface. False: no
  /// surface is found there.
  bool moveTo(NearParts& pair, const Quat& q_WT, const Vec3& goal, Vec3& x, Vec3& nhat) noexcept;

  ConvexPairs& pairs_;
  const std::vector<ConvexSolid>& bodies_;
  const std::vector<FrictionCoefficients>& friction_;
  Law law_;
  std::vector<Contact> contacts_;  // by pair
  std::uint64_t tick_ = 0;
};

/// Height over a chord of length d of the smallest circle: how far a surface may fall away from its tangent plane, along
/// the normal. The print has sqrt(2 r^2 - d^2), which does not vanish with d.
double stepTowardsHandle(double radius, double d) noexcept;

}  // namespace presa
