#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/haptics/body_hits.h"
#include "framework/haptics/renderer.h"
#include "framework/haptics/touchables.h"
#include "framework/scene/surface_change.h"
#include "framework/scene/world.h"
#include "modules/haptics_proxy/friction.h"

namespace presa {

/// State of one finger, kept from tick to tick.
struct RenderedFinger {
  bool alive = false;
  std::int32_t frame = kNoBody;  ///< body whose coordinates hold `tip`; kNoBody: world
  ProxyState tip;
  double radius = 0;         ///< radius of the moved sphere [m]
  double lift = 0;           ///< excess of `radius` over the fingertip radius, not 0 for a point [m]
  Vec3 p_WH = Vec3::Zero();  ///< HIP of the last tick [m]
  std::unique_ptr<Surroundings> near;
};

/// The surface parameters in force. Both references must outlive the stages.
struct SurfacesInForce {
  const Scene& scene;
  const std::vector<Material>& materials;  ///< as Scene::materials
  const Material& of(std::int32_t body) const noexcept {
    return materials[scene.bodies[static_cast<std::size_t>(body)].material];
  }
};

/// Data of one finger's tick, shared by its stages. Working frame A: the body that was next to the finger at the start.
struct FingerTick {
  std::size_t index = 0;
  const FingerInput& input;
  RenderedFinger& finger;
  FingerContact& out;
  ContactExchange& all;
  const Touchables& touchables;
  double time = 0, period = 0;  ///< [s]
  double r = 0;
  double approach = 0;  ///< maximum distance by which a surface may have approached the finger in this tick [m]
  Pose X_WA = {};
  Vec3 g = Vec3::Zero();  ///< HIP in A
  ProxyContact contact = {};
  const BoundedList<RenderedContact>& own_contacts;  ///< of the renderer, in A
  std::span<const BodyFriction> friction = {};       ///< with each body that holds the finger; empty without friction
  double softness = 1;  ///< stiffness of the surface over that of its material, from surface effects
  bool broken = false;  ///< a plug-in broke its contract: no force
  /// Body whose coordinates hold the finger's state from the next tick on; X_BA, if it is another.
  std::int32_t next_frame = kNoBody;
  Pose X_BA = {};
};

/// One stage of a finger's tick. The list of stages is built once and holds only the effects that the scene uses.
/// Thread: haptic; apply is nonblocking.
class FingerStage {
 public:
  virtual ~FingerStage() = default;
  virtual void apply(FingerTick& tick) noexcept = 0;
  /// Transforms what the stage keeps of the finger from tick to tick into the coordinates of the next frame.
  virtual void changeFrame(std::size_t /*finger*/, const Pose& /*X_BA*/) noexcept {}
  /// Description for `presa explain`.
  virtual std::string what() const = 0;
};

/// The friction laws of the scene.
class FrictionStage : public FingerStage {
 public:
  /// "friction law 'x' of material 'y'" that broke its contract, or none. Thread: any.
  virtual std::optional<std::string> brokenLaw() const = 0;
};

/// The surface effects of the scene.
class SurfaceStage : public FingerStage {
 public:
  /// The effect that broke its contract, or empty. Thread: any.
  virtual std::string broken() const = 0;
  /// Whether friction() has something to say. Thread: main.
  virtual bool changesFriction() const = 0;
  /// Share of the coefficients of friction where the finger touches the body, 0 to 1. Thread: haptic; nonblocking.
  virtual double friction(const FingerTick& tick, std::int32_t body) noexcept = 0;
};

// Each stage is in the file of its name, friction in law_stage.cpp; spring and damping are in render_stages.cpp.
/// `renderer` has a mover, and must outlive the stage, as must `places`, which the coefficients depend on; null: they
/// are the same all over a body.
std::unique_ptr<FrictionStage> makeFriction(const SurfacesInForce& surfaces, const Renderer& renderer,
                                            SurfaceStage* places);
/// `change` must outlive the stage, too.
std::unique_ptr<FrictionStage> makeChangingFriction(const SurfacesInForce& surfaces, const Renderer& renderer,
                                                    SurfaceStage* places, const In<SurfaceChange>& change);
/// `world` and `hits` must outlive the stage; null: no effect hears hits.
std::unique_ptr<SurfaceStage> makeSurfaces(const World& world, const SurfacesInForce& surfaces,
                                           const In<BodyHits>* hits);
/// Writes contact state and spring force, and counts pop-through, lost coverage and leaps.
std::unique_ptr<FingerStage> makeSpring(const SurfacesInForce& surfaces);
/// The same for scenes with surface effects, which may leave less than the material's stiffness.
std::unique_ptr<FingerStage> makeSoftSpring(const SurfacesInForce& surfaces);
std::unique_ptr<FingerStage> makeDamping(const SurfacesInForce& surfaces);
/// It needs the spring's depth and the coefficients of friction.
std::unique_ptr<FingerStage> makeTorsion(const SurfacesInForce& surfaces);
/// Sums the force of a finger on one body. Last of all.
std::unique_ptr<FingerStage> makeImpulse(std::size_t fingers);

}  // namespace presa
