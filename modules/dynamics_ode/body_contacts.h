#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/broad_phase.h"

namespace presa::ode {

/// Finds where bodies touch. ODE reports each contact with its normal from the second geometry into the first and
/// depth >= 0; here it becomes ours. Pairs are taken in scene order whatever the broad phase says, so that the
/// same state gives the same contacts to the bit.
class BodyContacts {
 public:
  static constexpr int kMaxPerPair = 8;
  explicit BodyContacts(const BodySet& bodies) : broad_phase_(bodies) {}
  /// Fills `contacts` with every contact between a body that is awake and another. A sleeping one that is met is handed to
  /// `wake(i)`, which must wake it: it then counts as awake.
  template <class Wake>
  void find(const BodySet& bodies, std::vector<BodyContact>& contacts, Wake wake) {
    while (const std::optional<std::size_t> met = collideAwake(bodies, contacts)) wake(*met);
  }

 private:
  static constexpr int kMaxReported = 64;  ///< asked of ODE per pair, then thinned to kMaxPerPair
  /// Stops at the first sleeping body that is met.
  std::optional<std::size_t> collideAwake(const BodySet& bodies, std::vector<BodyContact>& contacts);
  void collidePair(const BodySet& bodies, const BroadPhase::Pair& pair, std::vector<BodyContact>& contacts);

  BroadPhase broad_phase_;
  dContactGeom reported_[kMaxReported];
};

}  // namespace presa::ode
