#pragma once
#include <memory>
#include <string>

#include "framework/haptics/body_hits.h"
#include "framework/haptics/renderer.h"
#include "framework/haptics/touchables.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/plugin_element.h"
#include "framework/scene/world.h"

namespace presa {

/// One tool that touches the body of an effect, in one haptic tick. Vectors in the working frame A.
struct SurfaceInput {
  std::size_t tool;              ///< index of the scene's device role
  double time;                   ///< of the tick [s]
  double period;                 ///< [s]
  double radius;                 ///< of the tool [m]
  const Vec3& g;                 ///< where the device is [m]
  const ProxyContact& contact;   ///< what the renderer answered, with friction
  const Pose& X_WA;              ///< pose of A
  const Touchables& touchables;  ///< poses of all bodies in this tick
  const Surroundings& near;      ///< the pieces of contact.active are those of Point::kGodObject
  /// Hits between the bodies, for effects whose manifest says needs="hits"; null in scenes without such an effect.
  const BodyHits* hits;

  /// Takes vectors of A to coordinates of the body: p_B = X_BA(body) * p_A.
  Pose X_BA(std::int32_t body) const noexcept { return touchables.frameOf(body).inverse() * X_WA; }
  /// Touched point of the body without friction, in the body's coordinates [m].
  Vec3 touched_B() const noexcept { return X_BA(contact.body) * (contact.state.god_object - radius * contact.nhat); }
  /// Tangent frame of the touched face (framework/geometry/tangent_frame.h), of one of them on an edge. x and y of
  /// X_BT().inverse() * touched_B() are the place on the face [m].
  Pose X_BT() const noexcept;
};

/// What an effect may change. The force on the tool is stiffness * (depth * nhat + tangential).
struct SurfaceContact {
  Vec3 nhat;         ///< unit normal, body into tool
  double depth;      ///< [m]
  Vec3 tangential;   ///< displacement by friction [m]
  double stiffness;  ///< of the surface, at most that of its material [N/m]
};

/// Changes how a surface feels where a tool touches it: its normal, its height, its stiffness. One object for each body
/// that has the element, in itself or in its material, and for every touchable body if the element stands in the scene;
/// the effects of a body act in the order of the scene.
/// Thread: haptic, except for construction and what(); no allocation, lock, exception or system call.
class SurfaceEffect {
 public:
  virtual ~SurfaceEffect() = default;
  /// Unit normal of the piece of this body that holds the tool; `nhat` before this effect. The force keeps its
  /// magnitude and turns by less than 60 degrees, else the change is left out.
  virtual Vec3 normal(const SurfaceInput&, const ActiveSet::Member&, const Vec3& nhat) noexcept { return nhat; }
  /// A contact that is not finite, or stiffer than its material, ends the run: forces go to zero, and the fault is
  /// reported with the effect's name. Presa turns the tangential displacement with the normal, and lets it fall with
  /// the depth, so that friction keeps its bound.
  virtual void apply(const SurfaceInput&, SurfaceContact&) noexcept {}
  /// Description for `presa explain`.
  virtual std::string what() const = 0;
  /// Whether Presa asks friction() for its answer. Thread: main.
  virtual bool changesFriction() const { return false; }
  /// Share of the material's coefficients of friction where the tool touches the body, 0 to 1; beyond, as apply. Asked
  /// before the friction of the tick: input.contact is the one without friction.
  virtual double friction(const SurfaceInput&) noexcept { return 1; }
};

/// Table of a surface-effect plug-in; its manifest (framework/scene/manifest.h) names its elements.
struct SurfaceEffectPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< as in the manifest
  /// The effect on the body element.body; may throw (E596). The world stays alive as long as the effect.
  std::unique_ptr<SurfaceEffect> (*create)(const PluginElement& element, const World& world);
};

}  // namespace presa

/// Exports `table`, a SurfaceEffectPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_SURFACE_EFFECT_PLUGIN(table)                                                                         \
  extern "C" __attribute__((visibility("default"))) const presa::SurfaceEffectPlugin* presaSurfaceEffectPlugin() { \
    return &(table);                                                                                               \
  }
