#include <cmath>

#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::tall_tower {
namespace {

constexpr double kDuration = 60, kEdge = 0.05, kGravity = 9.81;

/// The scene has 60 blocks; those above `blocks` start asleep far away, each on its own.
std::vector<std::string> only(int blocks) {
  std::vector<std::string> sets;
  for (int i = blocks; i < 60; ++i) {
    sets.push_back("body/b" + std::to_string(i) + "/pos=" + number(5 + i) + " 0 " + number(kEdge / 2));
  }
  return sets;
}

std::vector<Finding> stand(int blocks, const Method& method) {
  Pile pile(specOf("tall_tower.xml", only(blocks) + method, kDuration), "b" + std::to_string(blocks - 1));
  pile.run();
  return {pile.displacement(0.5), pile.fastest(std::sqrt(2 * kGravity * blocks * kEdge) / 10, "nothing falls")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "tall_tower";
  result.title = "Towers of 20, 40 and 60 cubes stand for a minute";
  result.source =
      "Convergence of an iterative solver takes the square of the height; from 40 cubes on such towers walk and "
      "explode.";
  result.oracle = "Each cube stands in the middle of the one below: the tower stands, its top within 0.5 mm.";
  result.scene = "tall_tower.xml";
  for (const int blocks : {20, 40, 60}) {
    for (const Method& method : {ours(), twentyIterations()}) {
      Trial trial;
      trial.parameters = {{"cubes", std::to_string(blocks)}};
      trial.method = method.name;
      if (!method.own()) trial.expected = Verdict::kUnstable;
      trial.run = [=] { return stand(blocks, method); };
      trial.quick = blocks == 60 && method.own();
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::tall_tower
