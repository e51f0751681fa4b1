#pragma once
#include <vector>

#include "framework/haptics/body_hits.h"
#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"

namespace presa::ode {

/// Finds the hits of a sub-step: contacts at which two bodies approached each other, would have met within it, and
/// were stopped by the solver. The time is that at which the gap closes. Nonblocking after construction while the
/// contacts are within their room.
class HitFinder {
 public:
  /// `room`: hits that are kept.
  HitFinder(std::size_t room, std::size_t contact_room) : hits_(room) { approaches_.reserve(contact_room); }
  /// Before the solve.
  void begin(const std::vector<BodyContact>& contacts, const BodySet& bodies);
  /// After it; `time`: of the sub-step's start, `h`: its length [s].
  void end(const std::vector<BodyContact>& contacts, const BodySet& bodies, double time, double h);

  const BodyHits& hits() const noexcept { return hits_; }

 private:
  std::vector<double> approaches_;  // by contact [m/s]
  BodyHits hits_;
};

}  // namespace presa::ode
