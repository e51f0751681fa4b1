#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::tiny_and_huge {
namespace {

constexpr int kBlocks = 5, kAll = 10;  // of the harmonic stack, and in the scene
constexpr double kDensity = 600;       // [kg/m^3], as in the scene

struct Stack {
  double length = 0, share = 0;  ///< [m]; of the largest overhang
  Method method;
};

std::string text(const Vec3& v) { return number(v.x()) + " " + number(v.y()) + " " + number(v.z()); }

/// The stack of the case overhang with blocks of length, length / 2 and length / 5; those that are left over lie away.
std::vector<std::string> setsOf(const Stack& stack) {
  const double l = stack.length, s = l / 0.1;
  const Vec3 block(l, l / 2, l / 5);
  // no more than a tonne, the heaviest of the sane range
  const std::string mass = number(std::min(1000.0, kDensity * block.prod()));
  std::vector<std::string> sets{"dynamics/sleeping=false", "body/floor/pos=" + text(s * Vec3(0, 0, -0.35)),
                                "body/floor/physics/box/size=" + text(s * Vec3(40, 2, 0.1)),
                                "body/table/pos=" + text(s * Vec3(-0.2, 0, -0.15)),
                                "body/table/physics/box/size=" + text(s * Vec3(0.4, 0.3, 0.3))};
  double end = 0;
  for (int k = kAll; k > 0; --k) {
    const bool used = k <= kBlocks;
    if (used) end += stack.share * l / (2 * k);
    const Vec3 p = used ? Vec3(end - l / 2, 0, block.z() * (kBlocks - k + 0.5)) : s * Vec3(5 + k, 0, -0.29);
    const std::string body = "body/b" + std::to_string(k - 1);
    for (const auto& [path, value] :
         {std::pair{"/pos=", text(p)}, std::pair{"/physics/box/size=", text(block)}, {"/physics/mass=", mass}}) {
      sets.push_back(body);
      sets.back().append(path).append(value);
    }
  }
  return sets;
}

std::vector<Finding> build(const Stack& stack) {
  const bool stands = stack.share < 1;
  const double time = std::sqrt(stack.length / 0.1);  // falls take the square root of the length
  Pile pile(specOf("overhang.xml", setsOf(stack) + stack.method, stands ? 10 : std::max(1.0, 5 * time)), "b0");
  pile.run();
  if (!stands) return {pile.heightLeft("the centre of mass of what lies above an edge is beyond it")};
  return {pile.displacement(1000 * 1e-4 * stack.length), pile.restSpeed()};  // 0.01 % of a block
}

}  // namespace

Case make() {
  Case result;
  result.name = "tiny_and_huge";
  result.title = "A harmonic stack of blocks of 1 mm to 10 m";
  result.source = "Statics has no preferred length; tolerances in metres, and margins of contacts, show here.";
  result.oracle = "Five blocks stand 1 % inside of the largest overhang and fall 1 % beyond it, at any size.";
  result.scene = "overhang.xml";
  for (const double length : {0.001, 0.01, 1.0, 10.0}) {
    for (const double share : {0.99, 1.01}) {
      for (const Method& method : {ours(), twentyIterations()}) {
        if (share > 1 && !method.own()) continue;  // a method that lets every stack fall proves nothing by it
        Trial trial;
        trial.parameters = {{"length", number(1000 * length) + " mm"},
                            {"overhang over the limit", number(share)},
                            {"blocks then", share < 1 ? "stand" : "fall"}};
        trial.method = method.name;
        if (!method.own()) trial.expected = Verdict::kUnstable;
        trial.run = [stack = Stack{length, share, method}] { return build(stack); };
        trial.quick = length < 0.1;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::tiny_and_huge
