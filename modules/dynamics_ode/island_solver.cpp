#include "modules/dynamics_ode/island_solver.h"

#include <algorithm>

namespace presa::ode {
namespace {

// of a small island that is in trouble: time is no question
constexpr int kFallbackIterations = 1000;

}  // namespace

IslandSolver::IslandSolver(Engine& engine, BodySet& bodies, const OdeOptions& options)
    : engine_(engine), bodies_(bodies), options_(options) {}

bool IslandSolver::isDirect(const Islands::Island& island) const noexcept {
  switch (options_.method.solver) {
    case DynamicsSettings::Solver::kDirect:
      return true;
    case DynamicsSettings::Solver::kIterative:
      return false;
    default:
      return island.contacts <= options_.direct_limit;
  }
}

int IslandSolver::iterations(std::size_t contacts, int substeps) const noexcept {
  if (options_.method.iterations > 0) return static_cast<int>(options_.method.iterations);
  const int affordable = options_.iteration_budget / std::max(1, static_cast<int>(contacts));
  const int least = substeps > 1 ? options_.least_iterations_of_substep : options_.least_iterations;
  return std::min(options_.most_iterations, std::max(least, affordable / substeps));
}

// True when there is such a body.
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

bool IslandSolver::solve(Islands& islands, const std::vector<char>& wanted, double h, int iterations) {
  const auto wants = [&](std::size_t i, bool direct) {
    const std::size_t island = islands.of(i);
    return wanted[island] != 0 && isDirect(islands[island]) == direct;
  };
  bool fell_back = false;
  if (enableWhere([&](std::size_t i) { return wants(i, true); }) && !engine_.solveDirectly(h)) {
    fell_back = solveEachDirectly(islands, wanted, h, iterations);
  }
  if (enableWhere([&](std::size_t i) { return wants(i, false); })) engine_.solveIteratively(h, iterations);
  return fell_back;
}

// After trouble in one of them: one by one, to see which.
bool IslandSolver::solveEachDirectly(Islands& islands, const std::vector<char>& wanted, double h, int iterations) {
  bool fell_back = false;
  for (std::size_t island = 0; island < bodies_.size(); ++island) {
    if (!bodies_.awake(island) || islands.of(island) != island) continue;
    if (wanted[island] == 0 || !isDirect(islands[island])) continue;
    const auto belongs = [&](std::size_t i) { return islands.of(i) == island; };
    const auto putBack = [&] {
      for (std::size_t i = island; i < bodies_.size(); ++i) {
        if (bodies_.awake(i) && belongs(i)) bodies_.restore(i);
      }
    };
    putBack();
    enableWhere(belongs);
    if (engine_.solveDirectly(h)) continue;
    fell_back = true;
    putBack();
    bodies_.applyForces();
    engine_.solveIteratively(h, std::max(iterations, kFallbackIterations));
  }
  return fell_back;
}

}  // namespace presa::ode
