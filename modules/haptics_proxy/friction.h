#pragma once
#include "framework/haptics/friction_law.h"
#include "framework/haptics/renderer.h"

namespace presa {

/// The friction of one contact.
struct Friction {
  const FrictionLaw& law;
  double mu_static, mu_dynamic;
  double stiffness;  ///< of the surface [N/m]
  double period;     ///< [s]
  Quat q_BA = Quat::Identity();
};

/// What friction keeps of a finger's contact from tick to tick, in the working frame A. Without a contact it has no
/// meaning.
struct Held {
  Vec3 stick_anchor = Vec3::Zero();  ///< friction pulls the HIP towards it; its image on the surface is the proxy
  Vec3 g = Vec3::Zero();             ///< HIP of the last tick
  bool fresh = true;                 ///< friction begins anew in the next tick
  FrictionState law{};               ///< the law's own
};

/// Applies friction to a sliding `contact`: a sticking proxy stays at its last position or at the first touch, a
/// slipping one goes where the law's tangential force puts it. The tangential displacement is stored at the HIP, below
/// the surface, not recomputed from the proxy: on a curved surface the two differ, and the difference would accumulate
/// tick by tick. Writes the law's `answer` if there is a contact. False: the law broke its contract.
bool holdByFriction(ProxyContact& contact, const ProxyState& last, Held& held, const Vec3& g, double r,
                    const Friction& friction, const ProxyMover& mover, Surroundings& near,
                    FrictionAnswer& answer) noexcept;

}  // namespace presa
