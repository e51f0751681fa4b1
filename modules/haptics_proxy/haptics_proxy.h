#pragma once
#include <array>
#include <memory>
#include <vector>

#include "framework/graph/port.h"
#include "framework/scene/world.h"
#include "framework/state/contact_exchange.h"
#include "framework/state/contact_patch.h"
#include "framework/state/device_state.h"
#include "framework/state/object_state.h"
#include "modules/haptics_proxy/god_object.h"

namespace presa {

/// Constraint-based haptic rendering for every finger: HIP in, proxy, contact state and force out. A proxy lives
/// in the coordinates of the body next to it, so it moves with the body for free. Force on the finger:
///   f = k (p_WP - p_WH) + damping along the normal, k and mu of the touched body's material.
/// Meshes come as patches from the collision thread; primitives are exact and need none.
/// Thread: haptic; nonblocking. Errors: none; an invalid device sample gives zero force and keeps the proxy.
class HapticsProxy final : public Module {
 public:
  explicit HapticsProxy(std::shared_ptr<const World> world);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override;

 private:
  struct Proxy {
    bool alive = false;
    std::int32_t frame = kNoBody;  ///< body whose coordinates hold `tip`; kNoBody: world
    FingertipState tip;
    bool overlapping = false;
  };
  /// A body with a primitive as haptic geometry.
  struct Primitive {
    ConvexPiece piece;  ///< X_AG holds X_BG
    double radius = 0;  ///< of its bounding sphere about X_BG.p
  };

  void placeBodies(const Tick& tick) noexcept;
  Pose frameOf(std::int32_t body) const noexcept;
  void surround(std::size_t finger, const Proxy& proxy, const Vec3& p_WH, double reach) noexcept;
  void stepFinger(std::size_t finger) noexcept;
  void moveToFrame(Proxy& proxy, std::int32_t body) const noexcept;
  std::int32_t nearestBody(const Vec3& p) const noexcept;
  void writeContact(FingerContact& out, const Proxy& proxy, const ProxyContact& contact, const Pose& X_WA,
                    double r) const noexcept;
  Vec3 surfaceVelocity(std::int32_t body, const Vec3& p_W) const noexcept;
  void countPopThrough(std::size_t f, const ProxyContact& contact, double r) noexcept;

  std::shared_ptr<const World> world_;
  std::vector<Primitive> primitives_;
  std::vector<double> fingertip_radius_;
  std::vector<Pose> X_WB_;  ///< every body, now
  std::array<Proxy, kMaxFingers> proxies_;
  std::unique_ptr<Surroundings> surroundings_;

  In<DeviceState> device_{*this, "device_state"};
  In<ContactPatches> patches_{*this, "contact_patches", In<ContactPatches>::Optional{}};
  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}, WhenOld::kHold};
  Out<ContactExchange> contact_{*this, "contact_exchange"};
};

}  // namespace presa
