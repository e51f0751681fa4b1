#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/haptics/force_effects.h"
#include "framework/haptics/plugin_host.h"
#include "framework/haptics/renderer.h"
#include "framework/haptics/touchables.h"
#include "modules/haptics_proxy/commanded_surfaces.h"
#include "modules/haptics_proxy/effects.h"
#include "modules/haptics_proxy/finger_stage.h"
#include "modules/haptics_proxy/held_tools.h"

namespace presa {

/// Haptic rendering of all fingers: device state in, contact exchange out. A proxy is stored in the coordinates of the
/// body next to it, so it moves with that body. Force on the finger, with the touched body's material:
///   f = k (p_WP - p_WH), modified by the effects that the scene uses.
/// Tools with volume have a renderer of their own (framework/haptics/tool_renderer.h).
/// The collision thread's neighbourhoods limit the bodies to examine; without a neighbourhood all bodies are examined.
/// Thread: haptic; nonblocking. Errors: none; an invalid device sample gives zero force and keeps the proxy.
class HapticsProxy final : public Module, public PluginHost {
 public:
  HapticsProxy(const std::shared_ptr<const World>& world, const RunOptions& options)
      : HapticsProxy(world, effectsOf(*world, options)) {}
  HapticsProxy(std::shared_ptr<const World> world, const HapticEffects& effects);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override;
  std::optional<std::string> brokenPlugin() const override;
  std::vector<LeftOut> leftOut() const override { return effectsLeftOut(effects_); }

 private:
  /// First stage of a tick when a touchable body moves: selects the body poses.
  struct PlaceBodies {
    const char* what;
    void (*apply)(Touchables& touchables, const ObjectState& objects, double time) noexcept;
  };
  /// The commanded surfaces with the port of the commands.
  struct Commanded {
    Commanded(Module& owner, const Scene& scene)
        : settings(owner, "surface_settings", In<SurfaceSettings>::Optional{}), surfaces(scene) {}
    In<SurfaceSettings> settings;
    CommandedSurfaces surfaces;
  };
  /// The force effects with the port of their reactions.
  struct Effects {
    Effects(Module& owner, const World& world) : effects(world), reactions(owner, kEffectReactionsPort) {
      reactions.value = effects.reactions();
    }
    ForceEffects effects;
    Out<EffectReactions> reactions;
  };
  void addFingertips(const HapticEffects& effects, const SurfacesInForce& in_force);
  SurfacesInForce surfaces(const HapticEffects& effects);
  std::unique_ptr<FrictionStage> frictionOf(const HapticEffects& effects, const SurfacesInForce& surfaces);
  void stepFinger(std::size_t finger, const Tick& tick) noexcept;
  double gather(std::size_t finger, const Vec3& g, double period) noexcept;
  void checkContract(FingerTick& tick) noexcept;
  void changeFrame(FingerTick& tick) noexcept;

  std::shared_ptr<const World> world_;
  HapticEffects effects_;
  Touchables touchables_;
  std::vector<RenderedFinger> fingers_;        ///< as Scene::devices; empty if all of them are tools
  std::vector<std::size_t> fingertips_;        ///< the indices of those that are no tools
  std::vector<PlaceBodies> place_bodies_;      ///< none or one
  std::unique_ptr<Renderer> renderer_;         ///< null: no fingertips
  BoundedList<RenderedContact> own_contacts_;  ///< of the renderer, in this finger's tick
  std::atomic<bool> renderer_broken_{false};
  std::vector<std::unique_ptr<FingerStage>> finger_stages_;
  const FrictionStage* friction_ = nullptr;  ///< null: no friction
  SurfaceStage* surface_effects_ = nullptr;  ///< null: no surface effects

  In<DeviceState> device_{*this, "device_state"};
  In<FingerNeighbourhoods> neighbourhoods_{*this, "contact_patches", In<FingerNeighbourhoods>::Optional{}};
  In<ObjectState> objects_;
  std::optional<In<SurfaceChange>> surface_change_;      // only if friction can change
  std::optional<In<BodyHits>> hits_;                     // only if a surface effect hears them
  std::vector<std::unique_ptr<Commanded>> commanded_;    // none or one
  std::vector<std::unique_ptr<Effects>> force_effects_;  // none or one
  std::vector<std::unique_ptr<HeldTools>> tools_;        // none or one
  Out<ContactExchange> contact_{*this, "contact_exchange"};
};

}  // namespace presa
