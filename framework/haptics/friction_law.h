#pragma once
#include <memory>

#include "framework/core/math/spatial.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/plugin_element.h"

namespace presa {

/// A law's own memory of one contact. Zero for a new contact. Presa carries it from tick to tick with the body.
struct FrictionState {
  Vec3 vector = Vec3::Zero();  ///< working frame A; turns with the body
  double number = 0;           ///< in the law's own unit
};

/// One finger against one body in one haptic tick. Of several bodies that hold the finger, each has a share of the
/// stiffness, and is asked as if it held the finger alone: the normal force of the body is its share of stiffness *
/// depth. Vectors in the working frame A, which is fixed to the touched body; q_BA
/// turns them into the body's own axes, for laws that differ by direction.
/// The finger F is tied to an anchor on the surface by the spring of the surface: f_t = stiffness * stretch.
struct FrictionInput {
  double period = 0;             ///< [s]
  bool fresh = false;            ///< first tick of the contact
  bool slipping = false;         ///< answer of the last tick; fresh: whether the finger already slips
  double mu_static = 0,          ///< of the material, as in force in this tick [-]
      mu_dynamic = 0;            ///< the same for a slipping finger [-]
  double stiffness = 0;          ///< of the surface [N/m]
  double depth = 0;              ///< > 0; the normal force is stiffness * depth [m]
  Vec3 nhat = Vec3::UnitZ();     ///< surface normal, body into finger
  Vec3 stretch = Vec3::Zero();   ///< tangential, finger to anchor, if the anchor stays where it is [m]
  Vec3 slide = Vec3::Zero();     ///< tangential motion of the finger over the body since the last tick [m]
  Quat q_BA = Quat::Identity();  ///< takes A-vectors to B-vectors
};

/// The tangential force of the tick, and what the dynamics needs to continue it implicitly through its own step.
struct FrictionAnswer {
  /// The force on the finger is stiffness * stretch [m]. FrictionInput::stretch itself, unchanged, without slip: the
  /// anchor stays, and the proxy sticks to the bit. Otherwise the anchor moves along.
  Vec3 stretch = Vec3::Zero();
  bool slipping = false;  ///< the anchor moves; the next tick's FrictionInput::slipping
  /// Row of the dynamics: f_t = k_t * (displacement) + damping * (velocity), continued from the force of this tick, and
  /// |f_t| <= bound * normal force; a finger that reaches the bound within the step gets bound_sliding from then on.
  double bound = 0,            ///< >= 0 [-]
      bound_sliding = 0;       ///< 0 <= bound_sliding <= bound [-]
  double ratio = 1;            ///< k_t / stiffness, >= 0
  double damping = 0;          ///< >= 0 [N s/m]
  Vec3 damped = Vec3::Zero();  ///< part of `stretch` that damping causes [m]
};

/// Whether an answer for a contact of this depth keeps FrictionLaw's contract. Haptic thread.
inline bool keepsContract(const FrictionAnswer& answer, double depth) noexcept {
  constexpr double kRounding = 1 + 1e-9;
  // written so that NaN fails
  return answer.stretch.norm() <= answer.bound * depth * kRounding && answer.bound_sliding >= 0 && answer.ratio >= 0 &&
         answer.damping >= 0 && answer.damped.allFinite();
}

/// The bound of a law without one, such as viscous friction.
inline constexpr double kNoFrictionBound = 1e6;

/// Friction between fingers and bodies. Written once: the answer holds for the haptic tick and for the dynamics.
/// One object for each material that names the law; it has no state of its own, so all fingers share it.
class FrictionLaw {
 public:
  virtual ~FrictionLaw() = default;
  /// An answer that is not finite, or a stretch above bound * depth, ends the run: forces go to zero, and the fault is
  /// reported with the law's name.
  /// Thread: haptic; no allocation, lock, exception or system call.
  virtual FrictionAnswer hold(const FrictionInput& input, FrictionState& state) const noexcept = 0;
};

/// Table of a friction-law plug-in; its manifest (framework/scene/manifest.h) names its element, which stands in
/// `<friction>`. The law of a `<friction>` without such an element is kDefaultFrictionLaw.
struct FrictionLawPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< as in the manifest
  /// May throw (E596).
  std::unique_ptr<FrictionLaw> (*create)(const PluginElement& element);
};

inline constexpr const char* kDefaultFrictionLaw = "friction_cone";  ///< plug-in that stands for `<friction>` itself

}  // namespace presa

/// Exports `table`, a FrictionLawPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_FRICTION_LAW_PLUGIN(table)                                                                       \
  extern "C" __attribute__((visibility("default"))) const presa::FrictionLawPlugin* presaFrictionLawPlugin() { \
    return &(table);                                                                                           \
  }
