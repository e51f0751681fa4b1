#pragma once
#include "modules/dynamics_ode/contact_solver/contact_problem.h"

namespace presa::ode {

/// Steps a body alone on a hinge or a slider to something that does not move, such as a door or a drawer, over `h` [s] in
/// the position of its axis: the joint closes to rounding, and a body without torque turns evenly. Velocities belong to
/// half steps, as those of NewtonSolver do with joints; with stops, friction, motors and springs they are those of the
/// same minimisation. Symplectic and of second order (Störmer-Verlet) [Hairer2006]; nonblocking.
///
/// False, with `problem` as it was, where the island is something else, where the joint is further open than a step may
/// close, and where a force swings the body faster than a step can follow.
bool stepOnAxis(ContactProblem& problem, double h) noexcept;

}  // namespace presa::ode
