#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/broad_phase.h"
#include "modules/dynamics_ode/parallel_boxes.h"

namespace presa::ode {

/// Finds where bodies touch. ODE reports each contact with its normal from the second geometry into the first and
/// depth >= 0; here it becomes ours. Where `ahead` says so for both bodies, contacts are also found a step before they touch, with a
/// gap: without, a body arrives up to v h inside the other. Pairs are taken in scene order whatever the broad phase says, so that the
/// same state gives the same contacts to the bit.
class BodyContacts {
 public:
  static constexpr int kMaxPerPair = 8;
  BodyContacts(const BodySet& bodies, const Vec3& gravity) : broad_phase_(bodies), gravity_(gravity) {}
  /// Fills `contacts` with every contact between a body that is awake and another. A sleeping one that is met is handed to
  /// `wake(i)`, which must wake it: it then counts as awake.
  template <class Wake>
  void find(const BodySet& bodies, const std::vector<char>& ahead, double h, std::vector<BodyContact>& contacts,
            Wake wake) {
    while (const std::optional<std::size_t> met = collideAwake(bodies, ahead, h, contacts)) wake(*met);
  }

 private:
  static constexpr int kMaxReported = 64;  ///< asked of ODE per pair, then thinned to kMaxPerPair
  /// Stops at the first sleeping body that is met.
  std::optional<std::size_t> collideAwake(const BodySet& bodies, const std::vector<char>& ahead, double h,
                                          std::vector<BodyContact>& contacts);
  void collidePair(const BodySet& bodies, const BroadPhase::Pair& pair, double h, std::vector<BodyContact>& contacts);
  void report(const BodySet& bodies, std::size_t A, std::size_t B, double same, std::vector<BodyContact>& contacts);
  void reportNearing(const BodySet& bodies, std::size_t A, std::size_t B, double h, std::vector<BodyContact>& contacts,
                     std::size_t first);
  /// By how much two bodies may approach each other at a contact within `h` [m].
  double mayClose(const BodySet& bodies, const BodyContact& contact, double h) const;

  BroadPhase broad_phase_;
  ParallelBoxes parallel_boxes_;
  const Vec3 gravity_;
  dContactGeom reported_[kMaxReported];
};

}  // namespace presa::ode
