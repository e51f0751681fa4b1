#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::wall_of_343 {
namespace {

constexpr int kSide = 7;
constexpr double kEdge = 0.05;  // as in the scene [m]

/// Places with `gap` between the columns [m]; the layers touch.
std::vector<std::string> setsOf(double gap) {
  std::vector<std::string> sets;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const double x = (i % kSide - 3) * (kEdge + gap), y = (i / kSide % kSide - 3) * (kEdge + gap);
    const int layer = i / (kSide * kSide);
    const double z = kEdge * (layer + 0.5);
    sets.push_back("body/c" + std::to_string(i) + "/pos=" + number(x) + " " + number(y) + " " + number(z));
  }
  return sets;
}

std::vector<Finding> stand(double gap, const Method& method) {
  const int corner = kSide * kSide * (kSide - 1);  // the highest, at an edge
  Pile wall(specOf("wall_of_343.xml", setsOf(gap) + method, 3), "c" + std::to_string(corner));
  wall.run();
  return {wall.displacement(0.1), wall.restsWithin(2)};
}

}  // namespace

Case make() {
  Case result;
  result.name = "wall_of_343";
  result.title = "343 cubes stand as a block of 7 x 7 x 7, touching their neighbours or a millimetre apart";
  result.source =
      "A wall of boxes is the usual demonstration of a rigid-body engine; here all touch all neighbours, so that "
      "nothing decides which contacts carry.";
  result.oracle = "Each cube stands on the one below: nothing moves, and all sleep within 2 s.";
  result.scene = "wall_of_343.xml";
  for (const double gap : {0.0, 0.001}) {
    for (const Method& method : {ours(), twentyIterations()}) {
      Trial trial;
      trial.parameters = {{"gap", number(1000 * gap) + " mm"}};
      trial.method = method.name;
      if (!method.own()) trial.expected = Verdict::kUnstable;
      // too many contacts for Newton's method: the small steps leave overlaps, which push the outer columns apart
      if (method.own() && gap == 0) trial.expected = Verdict::kDrift;
      trial.run = [=] { return stand(gap, method); };
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::wall_of_343
