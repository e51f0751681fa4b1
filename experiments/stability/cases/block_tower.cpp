#include <algorithm>
#include <iterator>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"

namespace presa::stability::block_tower {
namespace {

constexpr int kBlocks = 10;
constexpr double kHandDistance = 0.06;  // between the two pairs of fingers [m]

/// Two pairs of fingers on the lowest block: with one pair the tower could swing about the line between the tips.
/// `lift` 0: the fingers stay away.
DeviceList handsOn(double lift) {
  Pinch pinch;
  pinch.width = 0.06;
  pinch.depth = lift > 0 ? 0.003 : 0;
  pinch.open = lift > 0 ? 0.003 : 0.05;
  pinch.close_begin = lift > 0 ? 0.05 : 1e9;
  pinch.lift = lift;
  DeviceList all;
  for (const double side : {-0.5, 0.5}) {
    pinch.center = {0, side * kHandDistance, 0.015};
    DeviceList pair = pinchFingers(pinch);
    std::move(pair.begin(), pair.end(), std::back_inserter(all));
  }
  return all;
}

std::vector<std::string> blocksFrom(std::vector<std::string> below) {
  for (int i = 0; i < kBlocks; ++i) below.push_back("block" + std::to_string(i));
  return below;
}

/// Block positions at which neighbours just touch; by rounding some overlap and some do not.
std::vector<std::string> justTouching() {
  std::vector<std::string> sets;
  for (int i = 0; i < kBlocks; ++i) {
    sets.push_back("body/block" + std::to_string(i) + "/pos=0 0 " + number(0.015 + 0.03 * i));
  }
  return sets;
}

enum class Tower { kStanding, kJustTouching, kLifted };

std::vector<Finding> hold(Tower tower, bool iterative) {
  const bool lifted = tower == Tower::kLifted;
  std::vector<std::string> sets;
  if (tower == Tower::kJustTouching) sets = justTouching();
  if (iterative) sets.insert(sets.end(), {"dynamics/solver=iterative", "dynamics/iterations=20"});
  const double lift = lifted ? 0.05 : 0;
  StudyRun run(specOf("block_tower.xml", sets, lifted ? 10 : 30), handsOn(lift));
  const BoxStack stack(run.world(), lifted ? blocksFrom({}) : blocksFrom({"table"}));
  return runAndJudge(run, stack, "block" + std::to_string(kBlocks - 1), "displacement within the tower",
                     "no block falls");
}

}  // namespace

Case make() {
  Case result;
  result.name = "block_tower";
  result.title = "Ten blocks stand, and are lifted by the lowest block";
  result.source = "A tall stack is a standard test of rigid-body engines; here fingers also lift it.";
  result.oracle = "A tower of equal blocks stays a tower when it is moved gently.";
  result.scene = "block_tower.xml";
  const std::vector<std::pair<Tower, std::string>> towers{{Tower::kStanding, "standing 30 s"},
                                                          {Tower::kJustTouching, "just touching, 30 s"},
                                                          {Tower::kLifted, "lifted 50 mm, 10 s"}};
  for (const auto& [tower, name] : towers) {
    for (const bool iterative : {false, true}) {
      Trial trial;
      trial.parameters = {{"tower", name}};
      trial.method = iterative ? "20 iterations" : kPresa;
      if (iterative) trial.expected = Verdict::kUnstable;
      trial.run = [tower = tower, iterative] { return hold(tower, iterative); };
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::block_tower
