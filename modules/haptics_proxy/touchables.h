#pragma once
#include <vector>

#include "framework/scene/world.h"
#include "framework/state/contact_patch.h"
#include "framework/state/object_state.h"
#include "modules/haptics_proxy/finger_stage.h"

namespace presa {

/// Every body that a finger can touch, where it is now. Thread: haptic; nonblocking but for construction.
class Touchables {
 public:
  explicit Touchables(const World& world);

  /// How moving bodies are placed in a tick; `objects` null: they are where the scene puts them.
  void interpolate(const ObjectState& objects, double time) noexcept;
  void hold(const ObjectState& objects) noexcept;

  Pose frameOf(std::int32_t body) const noexcept {
    return body == kNoBody ? Pose{} : X_WB_[static_cast<std::size_t>(body)];
  }
  /// Velocity of the body's point that is at p_W now [m/s].
  Vec3 velocityAt(std::int32_t body, const Vec3& p_W) const noexcept;
  /// Sets what the finger can meet while its centre stays within `reach` of the HIP. `patch` null: no mesh near.
  void surround(const Finger& finger, const Vec3& p_WH, double reach, const FingerPatch* patch,
                std::uint64_t patch_version) const noexcept;
  /// Carries the finger, and the point that goes with it, into the coordinates of `body`.
  void moveToFrame(Finger& finger, Vec3& point, std::int32_t body) const noexcept;

 private:
  /// A body with a primitive as haptic geometry.
  struct PrimitiveBody {
    ConvexPiece piece;  ///< X_AG holds X_BG
    double radius = 0;  ///< of its bounding sphere about X_BG.p
  };
  std::vector<PrimitiveBody> primitives_;
  std::vector<Pose> X_WB_;
  std::vector<std::int32_t> moving_;
  const ObjectState* objects_ = nullptr;  // of this tick
};

}  // namespace presa
