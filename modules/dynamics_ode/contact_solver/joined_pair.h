#pragma once
#include "modules/dynamics_ode/contact_solver/contact_problem.h"

namespace presa::ode {

/// Steps two bodies that one joint holds together, or one that it holds to something that does not move, over `h` [s],
/// alone: the method of NewtonSolver for joints (SHAKE), with one matrix of six rows instead of a sparse one of twelve,
/// and with rigid rows. For fixed, hinge, slider and ball, whose locked directions are axes of the joint's frame. Stops,
/// friction, motor and spring act on the way along the axis over the step. Linear and angular momentum of a pair are kept
/// to rounding; nonblocking.
///
/// False, with `problem` as it was, where the island is something else, where the joint does not close quickly, and where
/// it turns a light body faster than a step can follow.
bool stepJoinedPair(ContactProblem& problem, double h) noexcept;

}  // namespace presa::ode
