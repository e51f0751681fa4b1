#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::capsule_lying {
namespace {

std::vector<Finding> lie(double length, const Method& method) {
  Pile pile(specOf("capsule_lying.xml",
                   std::vector<std::string>{"body/capsule/physics/capsule/length=" + number(length)} + method, 5),
            "capsule");
  pile.run();
  return {pile.displacement(0.01), pile.restsWithin(2)};
}

}  // namespace

Case make() {
  Case result;
  result.name = "capsule_lying";
  result.title = "A capsule lies on a table";
  result.source =
      "A capsule that touches a box in one point rocks about it: it sank by 0.75 mm, wandered by 5.6 mm and never "
      "slept.";
  result.oracle = "It rests on the ends of its axis, where it was put, and sleeps within 2 s.";
  result.scene = "capsule_lying.xml";
  for (const double length : {0.02, 0.1, 0.3}) {
    Trial trial;
    trial.parameters = {{"length", number(length * 1000) + " mm"}};
    trial.method = kPresa;
    trial.quick = true;
    trial.run = [=] { return lie(length, ours()); };
    result.trials.push_back(std::move(trial));
  }
  return result;
}

}  // namespace presa::stability::capsule_lying
