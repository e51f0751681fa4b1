#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::falling_tower {
namespace {

constexpr int kBlocks = 20;
constexpr double kDuration = 3, kEdge = 0.05, kMass = 0.05, kGravity = 9.81;

std::vector<Finding> fall(double push, const Method& method) {
  std::vector<std::string> sets;
  for (int i = 0; i < kBlocks; ++i) {
    sets.push_back("body/b" + std::to_string(i) + "/velocity=" + number(push * i) + " 0 0");
  }
  Pile pile(specOf("falling_tower.xml", sets + method, kDuration), "b" + std::to_string(kBlocks - 1));
  pile.run();
  const double released = kMass * kGravity * kEdge * kBlocks * (kBlocks - 1) / 2;
  return {pile.energy(released, 0.5)};
}

}  // namespace

Case make() {
  Case result;
  result.name = "falling_tower";
  result.title = "A tower of 20 cubes is pushed over";
  result.source =
      "A solver that changes its method or its sub-steps while contacts come and go creates energy: 24 % of what can "
      "be set free, 2.3 J in one step, when each island chose its sub-steps.";
  result.oracle = "Energy never rises: contacts without restitution and friction only take it.";
  result.scene = "falling_tower.xml";
  for (const double push : {0.03, 0.054, 0.1}) {
    for (const Method& method : {ours(), twentyIterations()}) {
      Trial trial;
      trial.parameters = {{"push", number(push * 1000) + " mm/s a cube"}};
      trial.method = method.name;
      if (!method.own()) trial.expected = Verdict::kUnstable;
      trial.run = [=] { return fall(push, method); };
      trial.quick = method.own();
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::falling_tower
