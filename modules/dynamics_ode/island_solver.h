#pragma once
#include <vector>

#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// Steps islands of bodies with the solver that suits each: up to `direct_limit` contacts directly, larger ones
/// iteratively (or all alike, if the scene says so). An island on which the direct solver fails is restored, perturbed
/// by some nm/s and, if that fails too, solved iteratively; the other islands are not affected.
class IslandSolver {
 public:
  IslandSolver(Engine& engine, BodySet& bodies, const OdeOptions& options);

  bool isDirect(const Islands::Island& island) const noexcept;
  /// Set when some island is too large for the direct solver. All islands then share its sub-steps, and islands that no
  /// finger touches are solved directly only up to `crowded_limit` contacts.
  void setCrowded(bool crowded) noexcept { crowded_ = crowded; }
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
  bool crowded_ = false;
};

}  // namespace presa::ode
