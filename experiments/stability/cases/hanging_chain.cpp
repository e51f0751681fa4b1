#include <algorithm>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"

namespace presa::stability::hanging_chain {
namespace {

constexpr double kDuration = 20, kLink = 0.001;  // [s], [kg] as in the scene

Method smallSteps() { return {"small steps", {"dynamics/solver=small_steps"}}; }

std::vector<Finding> hang(double ratio, const Method& method) {
  StudyRun run(specOf("hanging_chain.xml",
                      std::vector<std::string>{"body/weight/physics/mass=" + number(kLink * ratio)} + method,
                      kDuration));
  const std::size_t weight = bodyNamed(run.world(), "weight");
  const Vec3 start = run.world().scene.bodies[weight].X_WB.p;
  double farthest = 0;
  Curve sag{"weight", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    const Vec3 moved = state.bodies[weight].X_WB_end.p - start;
    farthest = std::max(farthest, moved.norm());
    sag.x.push_back(state.time_end);
    sag.y.push_back(-1000 * moved.z());
  }));
  run.run();
  Finding result = finding("displacement of the weight", 1000 * farthest, "mm", 0.01, "rigid links hang still");
  result.plot_x = "time [s]";
  result.plot_y = "sag [mm]";
  result.curves = {decimated(std::move(sag))};
  return {result};
}

}  // namespace

Case make() {
  Case result;
  result.name = "hanging_chain";
  result.title = "A heavy weight hangs from a chain of light links";
  result.source =
      "The classic failure of iterative solvers: an error of a sweep grows with the square of the links and with the "
      "mass "
      "ratio.";
  result.oracle = "Rigid links hang still, for every mass ratio.";
  result.scene = "hanging_chain.xml";
  for (const double ratio : {10.0, 100.0, 1000.0, 10'000.0}) {
    for (const Method& method :
         {ours(), smallSteps(), Method{"direct", {"dynamics/solver=direct"}}, twentyIterations()}) {
      Trial trial;
      trial.parameters = {{"mass ratio", "1:" + number(ratio)}};
      trial.method = method.name;
      // sweeps over the rows carry a load by one link each
      if (method.name == twentyIterations().name || method.name == smallSteps().name)
        trial.expected = Verdict::kUnstable;
      trial.run = [=] { return hang(ratio, method); };
      trial.quick = method.own();
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::hanging_chain
