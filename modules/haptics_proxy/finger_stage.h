#pragma once
#include <memory>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/surface_change.h"
#include "framework/haptics/touchables.h"
#include "framework/scene/world.h"
#include "modules/haptics_proxy/god_object.h"

namespace presa {

/// What one finger carries from tick to tick.
struct Finger {
  bool alive = false;
  std::int32_t frame = kNoBody;  ///< body whose coordinates hold `tip`; kNoBody: world
  FingertipState tip;
  Vec3 penalty_nhat = Vec3::Zero();  ///< of the tick before, penalty only; zero: no contact
  double radius = 0;                 ///< of the sphere that is moved [m]
  double lift = 0;                   ///< by how much that is more than the fingertip's own: a true point needs some [m]
  Vec3 p_WH = Vec3::Zero();          ///< HIP of the tick before
  std::unique_ptr<Surroundings> near;
};

/// Carries the finger, and the point that goes with it, into the coordinates of `body`.
void moveToFrame(Finger& finger, Vec3& point, std::int32_t body, const Touchables& touchables) noexcept;

/// The surfaces that fingers touch, as they are in force. Both outlive whoever holds it.
struct SurfacesInForce {
  const Scene& scene;
  const std::vector<Material>& materials;  ///< as Scene::materials
  const Material& of(std::int32_t body) const noexcept {
    return materials[scene.bodies[static_cast<std::size_t>(body)].material];
  }
};

/// What the stages of one tick share about one finger. The working frame A is the body next to it when the tick began.
struct FingerTick {
  std::size_t index = 0;
  const FingerInput& input;
  Finger& finger;
  FingerContact& out;
  ContactExchange& all;
  const Touchables& touchables;
  double r = 0;
  double approach = 0;  ///< how much nearer any surface may have come to the finger in a tick [m]
  Pose X_WA;
  Vec3 g = Vec3::Zero();  ///< HIP in A
  ProxyContact contact;
};

/// One part of a finger's tick. The list of stages is made once, from what the scene calls for: an effect that it does not
/// name is not in the list. Thread: haptic; apply is nonblocking.
class FingerStage {
 public:
  virtual ~FingerStage() = default;
  virtual void apply(FingerTick& tick) noexcept = 0;
  /// In words, for `presa explain`.
  virtual const char* what() const = 0;
};

// Each in the file of its name, but for the two of rendering.
std::unique_ptr<FingerStage> makeGodObject();
std::unique_ptr<FingerStage> makePenalty();
std::unique_ptr<FingerStage> makeFriction(const SurfacesInForce& surfaces);
/// `change` outlives it.
std::unique_ptr<FingerStage> makeChangingFriction(const World& world, const In<SurfaceChange>& change);
std::unique_ptr<FingerStage> makeShading(const World& world);
/// Writes contact and spring force; counts what should not happen.
std::unique_ptr<FingerStage> makeSpring(const SurfacesInForce& surfaces);
std::unique_ptr<FingerStage> makeDamping(const SurfacesInForce& surfaces);

}  // namespace presa
