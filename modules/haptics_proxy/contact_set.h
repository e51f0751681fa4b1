#pragma once
#include "modules/haptics_proxy/finger_stage.h"

namespace presa {

// The contacts of a finger with each of the bodies that hold it. Thread: haptic; nonblocking.

/// Adds the bodies that hold a touching finger to ContactExchange::contacts and divides the spring among them: the
/// multipliers of each body's constraints, or the renderer's own contacts, and a share of the friction in proportion to
/// the normal force.
void divideContact(FingerTick& tick) noexcept;

/// After all stages: makes every contact a spring-damper of its own, which the dynamics solves as such, and its force on
/// the finger. Where several bodies hold the finger, writes the sum into the finger's forces.
///
/// The finger's spring F = k (P - H) + d (dP/dt - dH/dt) ends at a proxy that the planes n_j . P = u_j of the bodies
/// hold. With N = [n_1 n_2 ..] and M = inverse(N^T N), F has the multipliers k s + d ds/dt with ds/dt = M (du/dt - N^T
/// dH/dt): contact i alone is a spring M_ii k, and what the finger's motion and that of the other bodies do to it is the
/// same as if the finger had another velocity.
void finishContacts(FingerTick& tick) noexcept;

}  // namespace presa
