#pragma once
#include <vector>

#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// Steps islands of bodies with ODE's solvers: the iterative one where the scene says so, else the direct one. An island
/// on which the direct solver fails is restored, perturbed by some nm/s and, if that fails too, solved iteratively; the
/// other islands are not affected.
class IslandSolver {
 public:
  IslandSolver(Engine& engine, BodySet& bodies, const OdeOptions& options);

  bool isDirect() const noexcept { return options_.method.solver != DynamicsSettings::Solver::kIterative; }
  /// Iterations for one of `substeps` sub-steps with `contacts` contacts and `layers` layers of bodies.
  int iterations(std::size_t contacts, int layers, int substeps) const noexcept;
  /// Steps the islands with `wanted[island]` set over `h` [s]; their contacts must be in the engine.
  /// `fell_back[island]` receives whether the iterative solver had to replace the direct one.
  void solve(Islands& islands, const std::vector<char>& wanted, double h, int iterations, std::vector<char>& fell_back);

 private:
  template <class Choose>
  bool enableWhere(Choose choose);
  void putBack(Islands& islands, std::size_t island);
  bool solveNudged(Islands& islands, std::size_t island, double h);
  void solveEachDirectly(Islands& islands, const std::vector<char>& wanted, double h, int iterations,
                         std::vector<char>& fell_back);

  Engine& engine_;
  BodySet& bodies_;
  const OdeOptions options_;
};

}  // namespace presa::ode
