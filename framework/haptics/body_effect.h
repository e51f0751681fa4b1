#pragma once
#include <memory>

#include "framework/core/math/spatial.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/plugin_element.h"

namespace presa {

/// A free body at the start of one sub-step of the dynamics.
struct BodyEffectInput {
  double time = 0,                ///< of the start of the sub-step [s]
      step = 0;                   ///< length of the sub-step [s]
  std::int32_t body = kNoBody;    ///< index of the body in the scene
  Pose X_WB{};                    ///< pose of the body
  Vec3 p_WCm = Vec3::Zero();      ///< centre of mass [m]
  Vec3 v_WCm = Vec3::Zero();      ///< its velocity [m/s]
  Vec3 w_WB = Vec3::Zero();       ///< angular velocity [rad/s]
  double mass = 0;                ///< [kg]
  Mat3 inertia_B = Mat3::Zero();  ///< about the centre of mass, in the axes of B [kg m^2]
  Vec3 gravity_W = Vec3::Zero();  ///< [m/s^2]
};

/// How fast a wrench answers a change, as the largest rate in any direction; all >= 0. Zero: the wrench is constant
/// over the step.
struct BodyEffectRates {
  double damping = 0;         ///< largest -df/dv [N s/m]
  double stiffness = 0;       ///< largest -df/dp [N/m]
  double turn_damping = 0;    ///< largest -dtorque/dw [N m s/rad]
  double turn_stiffness = 0;  ///< largest -dtorque/dangle [N m/rad]
};

/// A force at the centre of mass and a torque about it, in W, at the state of the input.
struct BodyEffectWrench {
  Vec3 f_W = Vec3::Zero();       ///< [N]
  Vec3 torque_W = Vec3::Zero();  ///< [N m]
  /// The dynamics continues the wrench through the step with these rates:
  ///   m (v1 - v0) = h (f - damping (v1 - v0) - stiffness h v1 + gravity, contacts and all other forces),
  /// the linearly implicit Euler step, with one scalar for the Jacobian. It is first-order accurate with any rates,
  /// a state of rest or of constant speed is exact without stiffness, and a damper or a spring with its own rates is
  /// stable at any step. A wrench whose rates are left at zero is stable only below 2 mass / step of damping.
  BodyEffectRates rates{};
};

/// A force and a torque that the dynamics applies to bodies: drag, buoyancy, a spring to the world, a fan. One object
/// per element of the scene, and with the coupling haptic_rate a second one, on the haptic thread, for the bodies that
/// it moves. An element in a `<body>` acts on that body, one of the scene on every free body.
class BodyEffect {
 public:
  virtual ~BodyEffect() = default;
  /// The wrench on one body: |f_W| at most the element's max_force, |torque_W| at most its max_torque (a bound that the
  /// element does not have is zero), all numbers finite, the rates not negative. Otherwise the effect is off from then
  /// on, the forces on all fingers fade to zero, and the fault names the element. Called for each awake body in each
  /// sub-step; for a sleeping one once per step, at rest: it wakes when its wrench is not that of the step before.
  /// Thread: that of the object, dynamics or haptic; no allocation, lock, exception or system call.
  virtual BodyEffectWrench apply(const BodyEffectInput& input) noexcept = 0;
};

/// Table of a body-effect plug-in; its manifest (framework/scene/manifest.h) names its elements.
struct BodyEffectPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< as in the manifest
  /// One effect; may throw (E596). `bodies`: number of bodies in the scene.
  std::unique_ptr<BodyEffect> (*create)(const PluginElement& element, std::size_t bodies);
};

}  // namespace presa

/// Exports `table`, a BodyEffectPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_BODY_EFFECT_PLUGIN(table)                                                                      \
  extern "C" __attribute__((visibility("default"))) const presa::BodyEffectPlugin* presaBodyEffectPlugin() { \
    return &(table);                                                                                         \
  }
