#pragma once
#include <cstdint>

#include "framework/scene/scene.h"
#include "modules/dynamics_ode/contact_solver/newton_solver.h"
#include "modules/dynamics_ode/contact_solver/small_steps.h"

namespace presa::ode {

/// Whether the scene leaves the contacts to Presa's own solvers (contact_solver/), not to ODE's. The comparison methods
/// for friction and rotation are ODE's, too.
inline bool usesOwnSolvers(const DynamicsSettings& method) {
  using D = DynamicsSettings;
  if (method.solver == D::Solver::kAuto) {
    return method.friction == D::Friction::kIsotropic && method.rotation == D::Rotation::kExact;
  }
  return method.solver == D::Solver::kNewton || method.solver == D::Solver::kSmallSteps;
}

/// The methods chosen by the scene (`method`), and the parameters of the automatic choices.
struct OdeOptions {
  DynamicsSettings method;
  /// A step also gives what the fingers felt since the last step beyond what that one predicted (owed_impulses.h); steps
  /// as long as a tick.
  bool gives_what_is_felt = false;
  double look_ahead = 0;   ///< contacts are found that long before the step in which they close [s]
  std::uint64_t seed = 1;  ///< seed of the order in which the iterative solver visits its rows
  /// Newton's method up to so many products of blocks in an iteration (0.1 us each), small steps beyond.
  std::size_t newton_work = 2000;
  NewtonSolver::Options newton;
  SmallSteps::Options small_steps;
  /// A body that spins between fingers by more than `spin_turn` in a period gets that many steps more, up to
  /// `max_spin_steps`, where at most `max_spinning` bodies are awake: beside its axis by a hair, it would lose its spin
  /// to lever arms and inertia that stay as they were for a step.
  double spin_turn = 0.0125;  // [rad]
  int max_spin_steps = 40;
  std::size_t max_spinning = 8;

  // ODE's own solvers:
  /// Iterations unless the scene sets them: `max_iterations`, reduced so that contacts * iterations stays within the
  /// budget (2 ms), but at least `min_iterations`. In sub-steps at least `min_iterations_of_substep`, and for islands
  /// without finger contact at most the square of the layers (`Layers`).
  int max_iterations = 200;
  int iteration_budget = 40000;
  int min_iterations = 50;
  /// With an island of more contacts, or one that a finger touches, the iterative solver divides the period into
  /// `large_substeps` with fewer iterations each: a finger's spring converges with h^2 / iterations, and a heap overlaps
  /// less for less time (config/README.md).
  std::uint32_t large_island = 48;
  int large_substeps = 5;
  int min_iterations_of_substep = 20;
  /// Body-body contacts: fraction of the penetration removed per step (erp), and compliance cfm = h * softness /
  /// reduced mass, at most max_contact_cfm [m/(N s)]. A body on a table sinks g h^2 softness / (contacts * erp), below
  /// 1 um, whatever its mass. With a lower softness the iterative solver does not come to rest.
  double contact_erp = 0.2;
  double contact_softness = 2e-3;
  double direct_softness = 2e-4;  ///< softness for ODE's direct solver, which needs less
  double max_contact_cfm = 1e-4;
};

}  // namespace presa::ode
