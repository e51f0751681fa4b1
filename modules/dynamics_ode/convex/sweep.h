#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/geometry/convex_contact/cylinder.h"
#include "framework/geometry/convex_contact/manifold.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/broad_phase.h"

namespace presa::ode {

/// Stops bodies on their way through others within a step. Contacts are made at its start and are linear: they miss what
/// turns within the step, such as a coin that a blow on its rim sets spinning. So the ways of bodies that move further
/// than a part of the thinner one are followed by conservative advancement, and both bodies stop where they overlap by
/// 0.3 to 0.45 of it: less than half, so that the next step pushes them back to the side from which they came.
/// Convex shapes only.
class Sweep {
 public:
  explicit Sweep(const BodySet& bodies);
  /// After the solve of a step of `h` [s] that began with BodySet::beginStep.
  void stopShort(BodySet& bodies, double h);
  /// Bodies stopped, summed over all steps.
  std::uint64_t stops() const noexcept { return stops_; }

 private:
  struct Shape {
    const Hull* hull = nullptr;  // null: not convex, not followed
    Pose X_CmG;                  // of a body that moves
    std::size_t body = 0;
    double width = 0, rim = 0;  // [m]; rim: farthest point from the centre of mass
  };
  struct Way {
    Pose begin;  // of the centre of mass
    Vec3 shift = Vec3::Zero(), turn = Vec3::Zero();
    double end = 1;  // part of the way that the body may go
  };
  static constexpr std::size_t kNone = SIZE_MAX;
  bool moveLittle(const BodySet& bodies) const;
  void measureWays(const BodySet& bodies);
  bool stopPair(const BodySet& bodies, const BroadPhase::Pair& pair);
  bool stopShapes(const BodySet& bodies, std::size_t A, std::size_t B);
  // of shapes from here
  double travel(std::size_t A, std::size_t B) const;
  Pose geomPose(const BodySet& bodies, std::size_t i, double s) const;
  Separation separation(const BodySet& bodies, std::size_t A, std::size_t B, double s);
  double follow(const BodySet& bodies, std::size_t A, std::size_t B);

  std::vector<Shape> shapes_;
  std::vector<std::size_t> first_convex_;  // by body: its first convex shape; kNone: it is not followed
  std::vector<double> rims_;               // by body: the largest of its shapes
  double thinnest_ = 1e300;                // of all widths
  std::vector<Way> ways_;                  // by body
  BroadPhase broad_phase_;
  ManifoldMaker maker_;
  FacingHulls facing_;
  std::array<Hull, 2> placed_;
  std::uint64_t stops_ = 0;
};

}  // namespace presa::ode
