// Recovers from failures of the direct solver. ODE solves all enabled bodies at once, so
// islands are selected by enabling their bodies. A failed direct solve is repeated island by island: from the saved
// state, unperturbed, then with velocity perturbations of 1e-9 and 1e-7 m/s, finally with the iterative solver. Other
// islands are unaffected.
#include "modules/dynamics_ode/island_solver.h"

#include <algorithm>

namespace presa::ode {
namespace {

// for a small island that failed; its computing time is negligible
constexpr int kFallbackIterations = 1000;

}  // namespace

IslandSolver::IslandSolver(Engine& engine, BodySet& bodies, const OdeOptions& options)
    : engine_(engine), bodies_(bodies), options_(options) {}

int IslandSolver::iterations(std::size_t contacts, int layers, int substeps) const noexcept {
  if (options_.method.iterations > 0) return static_cast<int>(options_.method.iterations);
  const int affordable = options_.iteration_budget / (substeps * std::max(1, static_cast<int>(contacts)));
  const int max = std::min({affordable, options_.max_iterations, layers * layers});
  return std::max(substeps > 1 ? options_.min_iterations_of_substep : options_.min_iterations, max);
}

// Enables exactly the awake bodies that `choose` selects. True when there is at least one.
template <class Choose>
bool IslandSolver::enableWhere(Choose choose) {
  bool any = false;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_.awake(i)) continue;
    const bool on = choose(i);
    bodies_.enable(i, on);
    any = any || on;
  }
  if (any) bodies_.applyForces();
  return any;
}

void IslandSolver::solve(Islands& islands, const std::vector<char>& wanted, double h, int iterations,
                         std::vector<char>& fell_back) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (wanted[i] != 0) fell_back[i] = 0;
  }
  if (!enableWhere([&](std::size_t i) { return wanted[islands.of(i)] != 0; })) return;
  if (!isDirect()) {
    engine_.solveIteratively(h, iterations);
  } else if (!engine_.solveDirectly(h)) {
    solveEachDirectly(islands, wanted, h, iterations, fell_back);
  }
}

void IslandSolver::putBack(Islands& islands, std::size_t island) {
  for (std::size_t i = island; i < bodies_.size(); ++i) {
    if (bodies_.awake(i) && islands.of(i) == island) bodies_.restore(i);
  }
}

// The direct solver fails at ties, when two rows reach their bounds at the same instant; a body set down flat causes
// this to the last bit. An immeasurably small perturbation breaks the tie.
bool IslandSolver::solveNudged(Islands& islands, std::size_t island, double h) {
  for (const double speed : {0.0, 1e-9, 1e-7}) {
    putBack(islands, island);
    for (std::size_t i = island; i < bodies_.size() && speed > 0; ++i) {
      if (bodies_.awake(i) && islands.of(i) == island) bodies_.nudge(i, speed);
    }
    bodies_.applyForces();
    if (engine_.solveDirectly(h)) return true;
  }
  return false;
}

// After a failure: solves the islands one by one to find the failing one.
void IslandSolver::solveEachDirectly(Islands& islands, const std::vector<char>& wanted, double h, int iterations,
                                     std::vector<char>& fell_back) {
  for (std::size_t island = 0; island < bodies_.size(); ++island) {
    if (!bodies_.awake(island) || islands.of(island) != island) continue;
    if (wanted[island] == 0) continue;
    enableWhere([&](std::size_t i) { return islands.of(i) == island; });
    if (solveNudged(islands, island, h)) continue;
    fell_back[island] = 1;
    putBack(islands, island);
    bodies_.applyForces();
    engine_.solveIteratively(h, std::max(iterations, kFallbackIterations));
  }
}

}  // namespace presa::ode
