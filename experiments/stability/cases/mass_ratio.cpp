#include <algorithm>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"

namespace presa::stability {
namespace {

constexpr double kDuration = 30;
constexpr double kLightMass = 0.1;  // [kg], as in the scene

std::vector<Finding> stand(double ratio, bool iterative) {
  std::vector<std::string> sets{"body/heavy/physics/mass=" + number(kLightMass * ratio)};
  if (iterative) sets.insert(sets.end(), {"dynamics/solver=iterative", "dynamics/iterations=20"});
  StudyRun run(specOf("mass_ratio.xml", sets, kDuration));
  const BoxStack stack(run.world(), {"table", "light", "heavy"});
  const std::size_t heavy = bodyNamed(run.world(), "heavy");
  double deepest = 0, shift = 0;
  Curve height{"height of the heavy box", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    deepest = std::max(deepest, stack.penetration(state));
    shift = std::max(shift, stack.shift(state));
    height.x.push_back(state.time_end);
    height.y.push_back(1000 * state.bodies[heavy].X_WB_end.p.z());
  }));
  run.run();

  Finding walk = finding("displacement", 1000 * shift, "mm", 1, "rests where it was put");
  walk.plot_x = "time [s]";
  walk.plot_y = "height of the upper box [mm]";
  walk.curves.push_back(decimated(std::move(height)));
  return {finding("penetration", 1000 * deepest, "mm", 0.5, "rigid boxes do not overlap"), walk};
}

}  // namespace

Case massRatio() {
  Case result;
  result.name = "mass_ratio";
  result.title = "A heavy box stands on a light one";
  result.source =
      "The box-on-box comparison of rigid-body engines: iterative solvers with 20 iterations at 5 ms collapse from "
      "1:100 "
      "on.";
  result.oracle = "Two boxes on a table stay where they are for 30 s, whatever their masses.";
  result.scene = "mass_ratio.xml";
  for (const double ratio : {10.0, 100.0, 1000.0}) {
    for (const bool iterative : {false, true}) {
      Trial trial;
      trial.parameters = {{"mass ratio", "1:" + number(ratio)}};
      trial.method = iterative ? "20 iterations" : kPresa;
      if (iterative) trial.expected = Verdict::kUnstable;
      trial.run = [=] { return stand(ratio, iterative); };
      trial.quick = true;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability
