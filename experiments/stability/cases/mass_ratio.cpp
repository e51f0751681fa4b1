#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"

namespace presa::stability::mass_ratio {
namespace {

constexpr double kDuration = 30;
constexpr double kLightMass = 0.1;  // [kg], as in the scene

std::vector<Finding> stand(double ratio, bool iterative) {
  std::vector<std::string> sets{"body/heavy/physics/mass=" + number(kLightMass * ratio)};
  if (iterative) sets.insert(sets.end(), {"dynamics/solver=iterative", "dynamics/iterations=20"});
  StudyRun run(specOf("mass_ratio.xml", sets, kDuration));
  const BoxStack stack(run.world(), {"table", "light", "heavy"});
  return runAndJudge(run, stack, "heavy", "displacement", "the box stays in place");
}

}  // namespace

Case make() {
  Case result;
  result.name = "mass_ratio";
  result.title = "A heavy box stands on a light one";
  result.source =
      "The box-on-box comparison of rigid-body engines: iterative solvers with 20 iterations at 5 ms collapse from "
      "1:100 "
      "on.";
  result.oracle = "Two boxes on a table stay in place for 30 s, for every mass ratio.";
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

}  // namespace presa::stability::mass_ratio
