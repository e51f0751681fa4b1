#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "framework/haptics/surface_effect.h"

namespace presa {

/// The surface effects of a scene, by body. A plug-in that breaks its contract is broken for good.
/// Thread: haptic, except for construction, names and broken.
class SurfaceEffects {
 public:
  /// Loads the plug-ins. Throws InputError: the errors of pluginTable; E596 an effect that cannot be made.
  explicit SurfaceEffects(const World& world);

  /// Whether the body has effects.
  bool on(std::int32_t body) const noexcept { return !of_body_[static_cast<std::size_t>(body)].empty(); }
  /// Lets the effects of the touched body act on `contact`, which is also input.contact. `stiffness`: of its material;
  /// `softness`: the stiffness that is left over it. False: an effect broke its contract, now or before.
  bool act(const SurfaceInput& input, double stiffness, ProxyContact& contact, double& softness) noexcept;

  /// Whether an effect answers friction(). Thread: main.
  bool changeFriction() const;
  /// Share of the coefficients of friction where the tool touches input.contact.body, 0 to 1.
  double friction(const SurfaceInput& input) noexcept;

  /// Descriptions, each once, in the order of the bodies.
  std::vector<std::string> descriptions() const;
  /// "surface effect <ripples> of body 'cube'" that broke its contract, or empty. Thread: any.
  std::string broken() const;

 private:
  struct Effect {
    std::unique_ptr<SurfaceEffect> effect;
    std::string name;
  };

  bool turn(const SurfaceInput& input, ProxyContact& contact) noexcept;
  void breaks(const Effect& effect) noexcept;
  bool apply(std::int32_t body, const SurfaceInput& input, SurfaceContact& contact) noexcept;

  std::vector<std::vector<Effect>> of_body_;
  std::atomic<const Effect*> broken_{nullptr};
};

/// The effects that the scene's touchable bodies have: elements of the scene, one for each body, with `body` filled in,
/// and force shading for meshes with shading="smooth". An element that stands in the scene itself counts for every
/// touchable body. Those that need a proxy are left out if the renderer has none.
std::vector<PluginElement> surfaceEffectsOf(const Scene& scene);

/// One of them. Throws InputError: the errors of pluginTable; E596 an effect that cannot be made. Thread: main or view.
std::unique_ptr<SurfaceEffect> makeSurfaceEffect(const PluginElement& element, const World& world);

/// Plug-in of shading="smooth".
inline constexpr const char* kShading = "shading";

}  // namespace presa
