#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::overhang {
namespace {

// as in the scene
constexpr int kBlocks = 10;
constexpr double kLength = 0.1, kHeight = 0.02, kFloor = -0.3;  // [m]
constexpr double kStands = 30, kFalls = 5;                      // [s]

struct Stack {
  int blocks = 0;
  double share = 1;  ///< of the largest overhang of each block
  Method method;
};

/// The k-th block from the top reaches `share` length / (2 k) beyond the one below; blocks that are left over lie far
/// away.
std::vector<std::string> setsOf(const Stack& stack) {
  std::vector<std::string> sets{"dynamics/sleeping=false"};
  double end = 0;  // of the block, over the edge of the table
  for (int k = kBlocks; k > 0; --k) {
    const bool used = k <= stack.blocks;
    if (used) end += stack.share * kLength / (2 * k);
    const double x = used ? end - kLength / 2 : 5 + k;
    const double z = kHeight / 2 + (used ? kHeight * (stack.blocks - k) : kFloor);
    sets.push_back("body/b" + std::to_string(k - 1) + "/pos=" + number(x) + " 0 " + number(z));
  }
  return sets;
}

std::vector<Finding> build(const Stack& stack) {
  const bool stands = stack.share < 1;
  Pile pile(specOf("overhang.xml", setsOf(stack) + stack.method, stands ? kStands : kFalls), "b0");
  pile.run();
  if (!stands) return {pile.heightLeft("the centre of mass of what lies above an edge is beyond it")};
  // each edge yields by up to 2.5 um/N (yieldBound): under ten blocks these add up to 0.08 mm at the top, without tilt
  return {pile.displacement(0.1), pile.restSpeed()};
}

}  // namespace

Case make() {
  Case result;
  result.name = "overhang";
  result.title = "Blocks reach over the edge of a table, by up to 1.46 lengths";
  result.source =
      "The harmonic stack: R. T. Coffin, Am. Math. Monthly 30 (1923), 76; the balance of each edge leaves no room "
      "for contacts that yield or creep.";
  result.oracle =
      "n blocks reach 1/2 (1 + 1/2 + ... + 1/n) lengths: with 1 % less they stand, with 1 % more they fall.";
  result.scene = "overhang.xml";
  for (const int blocks : {3, 5, 10}) {
    for (const double share : {0.99, 1.01}) {
      for (const Method& method : {ours(), twentyIterations()}) {
        if (share > 1 && !method.own()) continue;  // a method that lets every stack fall proves nothing by it
        Trial trial;
        trial.parameters = {{"blocks", std::to_string(blocks)},
                            {"overhang over the limit", number(share)},
                            {"blocks then", share < 1 ? "stand" : "fall"}};
        trial.method = method.name;
        if (!method.own()) trial.expected = Verdict::kUnstable;
        trial.run = [stack = Stack{blocks, share, method}] { return build(stack); };
        trial.quick = blocks == 5;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::overhang
