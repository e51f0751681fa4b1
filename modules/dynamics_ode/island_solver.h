#pragma once
#include <vector>

#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// Steps islands of bodies, each with the solver that suits it: up to `direct_limit` contacts directly, larger ones iteratively (or
/// all alike, as the scene says). An island in which the direct solver reports trouble is put back to the start of the
/// step and nudged by a nanometre a second; if that is no help it is solved iteratively; the others are as if it had not been there.
class IslandSolver {
 public:
  IslandSolver(Engine& engine, BodySet& bodies, const OdeOptions& options);

  bool isDirect(const Islands::Island& island) const noexcept;
  /// An island too large for the direct solver is about: all take the sub-steps that it calls for, and what no finger
  /// touches is solved directly only up to `crowded_limit`.
  void setCrowded(bool crowded) noexcept { crowded_ = crowded; }
  /// Iterations for a step that `contacts` contacts of bodies in so many layers share, when it is one of `substeps`.
  int iterations(std::size_t contacts, int layers, int substeps) const noexcept;
  /// Steps the islands for which `wanted[island]` is set over `h`; the contacts are in the engine. Says of each in
  /// `fell_back[island]` whether the iterative solver had to take it over.
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
