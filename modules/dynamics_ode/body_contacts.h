#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/broad_phase.h"
#include "modules/dynamics_ode/convex/hull_contacts.h"
#include "modules/dynamics_ode/convex/inner_edges.h"
#include "modules/dynamics_ode/stand_in_geoms.h"

namespace presa::ode {

/// Which contacts are made before bodies touch, with a gap; without them a body could arrive up to v h inside another.
enum class Foresight : std::uint8_t {
  kNone,
  kPath,    ///< those towards which a body moves
  kAround,  ///< all that an awake body may meet within a step
};

/// Narrow-phase collision between bodies: convex polyhedra among each other by HullContacts, other shapes by ODE,
/// converted from its convention (normal from the second geometry into the first) to Presa's. Pairs are processed in
/// scene order whatever the broad phase returns, and the shapes of two bodies in theirs, so that equal states give
/// equal contacts, to the bit.
class BodyContacts {
 public:
  static constexpr int kMaxPerPair = 8;
  BodyContacts(const BodySet& bodies, const Vec3& gravity, Foresight foresight)
      : broad_phase_(bodies), hull_contacts_(bodies), inner_edges_(bodies), gravity_(gravity), foresight_(foresight) {}
  /// Fills `contacts` with every contact of an awake body. A sleeping body that is touched is passed to `wake(i)`,
  /// which must wake it; collision is then repeated with that body awake.
  template <class Wake>
  void find(const BodySet& bodies, double h, std::vector<BodyContact>& contacts, Wake wake) {
    while (const std::optional<std::size_t> met = collideAwake(bodies, h, contacts)) wake(*met);
  }

 private:
  static constexpr int kMaxReported = 64;  ///< contacts requested from ODE per pair, then reduced to kMaxPerPair
  /// Returns at the first sleeping body that is touched.
  std::optional<std::size_t> collideAwake(const BodySet& bodies, double h, std::vector<BodyContact>& contacts);
  void collidePair(const BodySet& bodies, const BroadPhase::Pair& pair, double h, std::vector<BodyContact>& contacts);
  /// Two bodies and one shape of each.
  struct Meeting {
    std::size_t A, B, shape_A, shape_B;
  };
  void collideSeveral(const BodySet& bodies, std::size_t A, std::size_t B, double h,
                      std::vector<BodyContact>& contacts);
  void collideShapes(const BodySet& bodies, const Meeting& of, double h, std::vector<BodyContact>& contacts);
  bool collideHulls(const BodySet& bodies, const Meeting& of, double h, std::vector<BodyContact>& contacts);
  void report(const BodySet& bodies, const Meeting& of, double same, std::vector<BodyContact>& contacts);
  void reportNearing(const BodySet& bodies, const Meeting& of, double h, std::vector<BodyContact>& contacts,
                     std::size_t first);
  /// Distance that two bodies may travel within `h` [m].
  double reach(const BodySet& bodies, std::size_t A, std::size_t B, double h) const;
  /// Distance by which two bodies may approach each other at a contact within `h` [m].
  double mayClose(const BodySet& bodies, const BodyContact& contact, double h) const;

  BroadPhase broad_phase_;
  HullContacts hull_contacts_;
  InnerEdges inner_edges_;
  ParallelBoxes parallel_boxes_;
  const Vec3 gravity_;
  const Foresight foresight_;
  dContactGeom reported_[kMaxReported];
};

}  // namespace presa::ode
