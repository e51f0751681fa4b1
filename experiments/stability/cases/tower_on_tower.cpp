#include <cmath>

#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::tower_on_tower {
namespace {

constexpr double kDuration = 3, kEdge = 0.05, kMass = 0.05, kGravity = 9.81;

std::vector<Finding> drop(int half, double height, const Method& method) {
  std::vector<std::string> sets;
  for (int i = 0; i < 20; ++i) {
    const bool far = i >= 2 * half;
    const double z = far ? kEdge / 2 : kEdge * (i + 0.5) + (i >= half ? height : 0);
    sets.push_back("body/b" + std::to_string(i) + "/pos=" + number(far ? 5 + i : 0) + " 0 " + number(z));
  }
  Pile pile(specOf("falling_tower.xml", sets + method, kDuration), "b" + std::to_string(2 * half - 1));
  pile.run();
  return {pile.energy(kMass * half * kGravity * height, 0.5), pile.upward(0.05),
          pile.fastest(1.01 * std::sqrt(2 * kGravity * height), "the fall: sqrt(2 g h)")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "tower_on_tower";
  result.title = "Cubes fall as a tower on a tower";
  result.source =
      "Merging stacks of equal height is a standard trap of sequential impulses; ten on ten were thrown 96 mm up.";
  result.oracle = "Two perfectly plastic towers meet, stay one tower, and nothing moves up.";
  result.scene = "falling_tower.xml";
  for (const int half : {3, 10}) {
    for (const double height : {0.005, 0.02, 0.05}) {
      for (const Method& method : {ours(), twentyIterations()}) {
        Trial trial;
        trial.parameters = {{"towers", std::to_string(half) + " on " + std::to_string(half)},
                            {"height", number(height * 1000) + " mm"}};
        trial.method = method.name;
        if (!method.own()) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return drop(half, height, method); };
        trial.quick = half == 10 && method.own();
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::tower_on_tower
