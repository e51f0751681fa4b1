#pragma once
#include <cstdint>

#include "framework/scene/scene.h"

namespace presa::ode {

/// The methods chosen by the scene (`method`), and the parameters of the automatic choices.
struct OdeOptions {
  DynamicsSettings method;
  std::uint64_t seed = 1;  ///< seed of the order in which the iterative solver visits its rows
  /// Maximum contacts of a directly solved island: a tower of ten has 40. Cost is cubic: 48 contacts take half a
  /// millisecond, 80 take 2 to 3, 150 take 20; a heap of 27 cubes is cheaper and no less accurate with iterative
  /// sub-steps.
  std::uint32_t direct_limit = 48;
  /// The same for an untouched island beside a larger one, because it must share all sub-steps of that one.
  std::uint32_t crowded_limit = 16;
  /// Iterations for larger islands unless the scene sets them: `max_iterations`, reduced so that contacts * iterations
  /// stays within the budget (2 ms), but at least `min_iterations`. In sub-steps at least
  /// `min_iterations_of_substep`, and for islands without finger contact at most the square of the layers (`Layers`).
  int max_iterations = 200;
  int iteration_budget = 40000;
  double visits_of_direct = 0.09;  ///< cost of a direct solution per contacts^3, in contacts * iterations
  int min_iterations = 50;
  /// With an island too large for the direct solver the period is divided into this many sub-steps with fewer
  /// iterations each: a finger's spring converges with h^2 / iterations, and a heap overlaps less for less time
  /// (config/README.md).
  int large_substeps = 5;
  int min_iterations_of_substep = 20;
  /// Body-body contacts: fraction of the penetration removed per step (erp), and compliance cfm = h * softness /
  /// reduced mass, at most max_contact_cfm [m/(N s)]. A body on a table sinks g h^2 softness / (contacts * erp), below
  /// 1 um, whatever its mass. With a lower softness the iterative solver does not come to rest.
  double contact_erp = 0.2;
  double contact_softness = 2e-3;
  double direct_softness = 2e-4;  ///< softness for the direct solver, which needs less
  double max_contact_cfm = 1e-4;
};

}  // namespace presa::ode
