#pragma once
#include <vector>

#include "modules/dynamics_ode/contact_solver/contact_problem.h"

namespace presa::ode {

/// Restitution between bodies, after a solver has ended their impacts without any: each contact that closed leaves at
/// its restitution times the speed at which it met (Newton's law), with Coulomb friction of the added impulse. The speed
/// of meeting counts the fall through the gap, so that a ball bounces as high as it must although it met within a step.
/// Where several contacts or friction would give more energy than there was, all added impulses are scaled down.
///
/// Bodies that meet slower than kMinBounce, or than gravity makes them in two steps, stay together: bounces shorter than
/// a step cannot be told apart. A bounce starts at the end of the step in which bodies met, late by at most a step.
///
/// Bodies that nothing touches fall along the exact parabola: with the velocity at the end of a step, as elsewhere, a
/// ball would lose height in proportion to the step in every flight.
class Bounce {
 public:
  /// Reserves memory for `bodies` and `contacts`.
  Bounce(std::size_t bodies, std::size_t contacts);
  /// Call before the solver.
  void before(const ContactProblem& problem, double h);
  /// Call after it: changes the velocities of the bodies.
  void after(ContactProblem& problem);

 private:
  struct Impact {
    std::size_t contact = 0;
    double speed = 0;    // closing, where the bodies meet [m/s]
    double near = 0;     // gap after the step up to which they have met [m]
    double impulse = 0;  // added, along the normal on B [N s]
    Vec3 friction = Vec3::Zero();
  };
  void fallExactly(ContactProblem& problem) const;
  /// Lever arm of a contact on a body, as the solvers take it: at the start of the step [m].
  Vec3 armOf(std::int32_t body, const ContactProblem::Contact& c) const;
  Vec3 velocityAt(const ContactProblem& problem, const ContactProblem::Contact& c) const;
  double massAlong(const ContactProblem& problem, const ContactProblem::Contact& c, const Vec3& direction) const;
  void give(ContactProblem& problem, const ContactProblem::Contact& c, const Vec3& impulse) const;
  double sweep(ContactProblem& problem);
  void boundEnergy(ContactProblem& problem);

  std::vector<ContactProblem::Body> begin_, solved_;  // before the step, and after the solver
  std::vector<Impact> impacts_;
  double h_ = 0;
};

}  // namespace presa::ode
