#pragma once
#include <memory>

#include "framework/core/math/spatial.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/plugin_element.h"

namespace presa {

/// A tool (fingertip) and the frame of the body that an effect belongs to, in one haptic tick.
struct EffectInput {
  double time = 0,               ///< of the tick [s]
      period = 0;                ///< of the haptic tick [s]
  Vec3 p_WT = Vec3::Zero();      ///< centre of the fingertip [m]
  Vec3 v_WT = Vec3::Zero();      ///< [m/s]
  double radius = 0;             ///< of the fingertip [m]
  Pose X_WB;                     ///< pose of the body now; identity for an effect of the scene
  bool oriented = false;         ///< the device measures the orientation; false: no torque reaches the hand
  Quat q_WT = Quat::Identity();  ///< orientation of the tool
  Vec3 w_WT = Vec3::Zero();      ///< its angular velocity [rad/s]
};

/// A force and a couple on the tool. The body of the effect gets their negatives, the force at the same point. The
/// torque on an oriented tool about its centre is the couple plus the moment of the force; a fingertip without
/// orientation gets the force alone.
struct EffectForce {
  Vec3 f_T_W = Vec3::Zero();       ///< [N]
  Vec3 p_WF = Vec3::Zero();        ///< point at which it acts on tool and body [m]
  Vec3 couple_T_W = Vec3::Zero();  ///< [N m]
};

/// A force or a torque on a tool that does not come from a contact: a magnet, a viscous field, a guide. Written once
/// for all bodies and tools; one object per element of the scene. It acts on the tool, and its reaction on the
/// element's body.
class ForceEffect {
 public:
  virtual ~ForceEffect() = default;
  /// The force on one tool: at most the element's max_force, its couple at most max_torque, and finite; a bound that
  /// the element does not have is zero. Otherwise the run's forces go to zero and the fault names the element. `tool`:
  /// index of the scene's device role.
  /// Thread: haptic; no allocation, lock, exception or system call.
  virtual EffectForce apply(std::size_t tool, const EffectInput& input) noexcept = 0;
};

/// Table of a force-effect plug-in; its manifest (framework/scene/manifest.h) names its elements.
struct ForceEffectPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< as in the manifest
  /// One effect; may throw (E596). `tools`: number of device roles.
  std::unique_ptr<ForceEffect> (*create)(const PluginElement& element, std::size_t tools);
};

}  // namespace presa

/// Exports `table`, a ForceEffectPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_FORCE_EFFECT_PLUGIN(table)                                                                       \
  extern "C" __attribute__((visibility("default"))) const presa::ForceEffectPlugin* presaForceEffectPlugin() { \
    return &(table);                                                                                           \
  }
