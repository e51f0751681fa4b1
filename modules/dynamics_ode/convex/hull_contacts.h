#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "framework/geometry/convex_contact/cylinder.h"
#include "framework/geometry/convex_contact/manifold.h"
#include "modules/dynamics_ode/body_set.h"

namespace presa::ode {

/// The contacts of convex shapes of bodies (BodySet::hullOf), with a memory from step to step. Within a step pairs must
/// be asked for in ascending order of their bodies, then of their shapes.
class HullContacts {
 public:
  /// Whether find() gives the contact of two such shapes: not of a cylinder and a shape that is not much larger.
  static bool collides(const Hull& A, const Hull& B);
  explicit HullContacts(const BodySet& bodies);

  void beginStep();
  /// The contact of shapes A and B within `margin` [m]; null when they are not both convex, or a
  /// cylinder meets a shape that is not much larger. Valid until the next call.
  const Manifold* find(const BodySet& bodies, std::size_t A, std::size_t B, double margin);

 private:
  struct Placed {
    std::uint64_t step = 0;
    Hull hull;
  };
  using Pair = std::pair<std::uint64_t, std::uint64_t>;  // of bodies, of shapes
  static Pair pairOf(const BodySet& bodies, std::size_t A, std::size_t B);
  struct Memory {
    Pair pair;
    ContactAxis axis;
    std::array<CylinderTurn, 2> turns;  // of A and B
  };
  const Hull& placed(const BodySet& bodies, std::size_t i);

  ManifoldMaker maker_;
  Manifold manifold_;
  FacingHulls facing_;
  std::vector<Placed> placed_;           // by shape: its hull in W
  std::vector<Memory> memories_, past_;  // of this step and of the last, sorted by pair
  std::size_t recalled_ = 0;             // into past_
  std::uint64_t step_ = 1;
};

}  // namespace presa::ode
