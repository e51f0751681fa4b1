#include <cmath>

#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::poured_heap {
namespace {

constexpr double kMass = 0.027, kGravity = 9.81, kMeanHeight = 0.292, kHighest = 0.544;
constexpr int kCubes = 250;

std::vector<Finding> pour(const Method& method) {
  Pile pile(specOf("poured_heap.xml", method.sets, 8), "c249");
  pile.run();
  return {pile.energy(kCubes * kMass * kGravity * kMeanHeight, 0.5), pile.restsWithin(5),
          pile.fastest(std::sqrt(2 * kGravity * kHighest), "no faster than the highest falls: sqrt(2 g H)")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "poured_heap";
  result.title = "250 cubes are poured into a bin";
  result.source =
      "The usual load test of rigid-body engines; heaps of blocks creep for ever where contacts flicker between edges.";
  result.oracle = "Energy only falls, and within 5 s every cube sleeps.";
  result.scene = "poured_heap.xml";
  for (const Method& method : {ours(), twentyIterations()}) {
    Trial trial;
    trial.method = method.name;
    if (!method.own()) trial.expected = Verdict::kUnstable;
    trial.run = [=] { return pour(method); };
    result.trials.push_back(std::move(trial));
  }
  return result;
}

}  // namespace presa::stability::poured_heap
