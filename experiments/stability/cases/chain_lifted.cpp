#include <algorithm>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"
#include "experiments/stability/methods.h"

namespace presa::stability::chain_lifted {
namespace {

constexpr double kLift = 0.05, kQuiet = 4, kDuration = 7;  // [m], [s] when the chain has come to rest, [s]

std::vector<Finding> lift(double ratio, const Method& method) {
  Grip grip;
  for (const double side : {-1.0, 1.0}) {
    grip.points.emplace_back(0, side * 0.01, 0.002);
    grip.normals.emplace_back(side * Vec3::UnitY());
  }
  grip.depth = 0.004;
  grip.lift = kLift;
  const std::vector<std::string> sets{"material/rubber/stiffness=2000",
                                      "body/weight/physics/mass=" + number(1e-4 * ratio)};
  StudyRun run(specOf("chain_lifted.xml", sets + method, kDuration), gripFingers(grip));
  const std::size_t weight = bodyNamed(run.world(), "weight"), handle = bodyNamed(run.world(), "handle");
  const double chain = run.world().scene.bodies[handle].X_WB.p.z() - run.world().scene.bodies[weight].X_WB.p.z();
  Vec3 low = Vec3::Constant(1e9), high = -low;
  double stretched = 0;
  Curve height{"weight", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    const Vec3 p = state.bodies[weight].X_WB_end.p, q = state.bodies[handle].X_WB_end.p;
    height.x.push_back(state.time_end);
    height.y.push_back(1000 * (p.z() + chain));
    if (state.time_end < kQuiet) return;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    stretched = std::max(stretched, std::abs((q - p).norm() - chain));
  }));
  run.run();
  Finding steady =
      finding("wandering of the weight while it is held", 1000 * (high - low).norm(), "mm", 0.1, "it hangs still");
  steady.plot_x = "time [s]";
  steady.plot_y = "height of the weight above its start [mm]";
  steady.curves = {decimated(std::move(height))};
  const double hangs = low.z() + chain;
  return {steady, finding("stretch of the chain", 1000 * stretched, "mm", 0.01, "rigid links"),
          finding("weight left behind", 1000 * (kLift - hangs), "mm", 2,
                  "lifted by 50 mm, less what the fingers' springs give way")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "chain_lifted";
  result.title = "Two fingers lift a chain with a heavy weight at its end";
  result.source =
      "Ten links and a mass ratio of 1:1000, the hardest for coupled fingers: the light handle is between both.";
  result.oracle = "The weight comes up by the lift and then hangs still.";
  result.scene = "chain_lifted.xml";
  for (const double ratio : {100.0, 1000.0, 5000.0}) {
    for (const Method& method : {ours(), explicitCoupling()}) {
      Trial trial;
      trial.parameters = {{"mass ratio", "1:" + number(ratio)}};
      trial.method = method.name;
      if (!method.own()) trial.expected = Verdict::kUnstable;
      trial.run = [=] { return lift(ratio, method); };
      trial.quick = method.own();
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::chain_lifted
