#pragma once
#include <cstdint>

#include "framework/scene/scene.h"

namespace presa::ode {

/// What the scene chose (`method`), and the numbers behind its automatic choices.
struct OdeOptions {
  DynamicsSettings method;
  std::uint64_t seed = 1;  ///< order in which the iterative solver visits its rows
  /// Contacts of an island up to which it is solved directly: a tower of ten has 40. Cubic: 48 contacts take half a
  /// millisecond, 80 take 2 to 3, 150 take 20; a heap of 27 cubes is cheaper and no worse with sub-steps of iterations.
  std::uint32_t direct_limit = 48;
  /// The same for what no finger touches beside a larger island: it shares all of that one's sub-steps.
  std::uint32_t crowded_limit = 16;
  /// Iterations for larger islands when the scene leaves them open: `most_iterations`, fewer when contacts * iterations
  /// would exceed the budget (2 ms), never below `least_iterations`. In sub-steps at least
  /// `least_iterations_of_substep`, and where no finger feels it no more than the square of the layers (`Layers`).
  int most_iterations = 200;
  int iteration_budget = 40000;
  double visits_of_direct = 0.09;  ///< times contacts^3: what a direct solution takes, in contacts * iterations
  int least_iterations = 50;
  /// With an island too large for the direct solver the period is cut into so many sub-steps, with fewer iterations each: a
  /// finger's spring converges with h^2 / iterations, and a heap overlaps less for less time (config/README.md).
  int large_substeps = 5;
  int least_iterations_of_substep = 20;
  /// Contact between bodies: part of the penetration removed per step, and compliance cfm = h * softness / reduced
  /// mass, at most max_contact_cfm [m/(N s)]. A body on a table sinks g h^2 softness / (contacts * erp), below 1 um,
  /// whatever its mass; less softness and the iterative solver does not come to rest.
  double contact_erp = 0.2;
  double contact_softness = 2e-3;
  double direct_softness = 2e-4;  ///< the same where the direct solver is at work, which needs less of it
  double max_contact_cfm = 1e-4;
};

}  // namespace presa::ode
