#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"

namespace presa::stability::coulomb_stick {
namespace {

constexpr double kRadian = std::numbers::pi / 180;
constexpr double kGravity = 9.81;
constexpr double kFriction = 0.5;  // of the scene
// the angle of friction is 26.565 degrees
constexpr double kBelow = 26.5, kAbove = 27.0;  // [degrees]

struct Method {
  std::string name;
  std::vector<std::string> sets;
};

StudySpec spec(double slope_deg, double heading_deg, const Method& method, double duration) {
  const double slope = slope_deg * kRadian, heading = heading_deg * kRadian;
  const double pull = kGravity * std::sin(slope);
  char gravity[120];
  std::snprintf(gravity, sizeof gravity, "world/gravity=%.17g %.17g %.17g", pull * std::cos(heading),
                pull * std::sin(heading), -kGravity * std::cos(slope));
  std::vector<std::string> sets = method.sets;
  sets.emplace_back(gravity);
  return specOf("coulomb_slope.xml", sets, duration);
}

std::vector<Finding> stick(double heading_deg, const Method& method) {
  StudyRun run(spec(kBelow, heading_deg, method, 60));
  const std::size_t tile = bodyNamed(run.world(), "tile");
  Curve creep{"creep", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    creep.x.push_back(state.time_end);
    creep.y.push_back(1000 * state.bodies[tile].X_WB_end.p.head<2>().norm());
  }));
  run.run();
  const double farthest = *std::max_element(creep.y.begin(), creep.y.end());
  Finding result = finding("creep in 60 s", farthest, "mm", 0.1, "slope below the angle of friction: the tile stays");
  result.plot_x = "time [s]";
  result.plot_y = "distance from the start [mm]";
  result.curves.push_back(decimated(std::move(creep)));
  return {result};
}

std::vector<Finding> slip(double heading_deg, const Method& method) {
  StudyRun run(spec(kAbove, heading_deg, method, 1));
  const std::size_t tile = bodyNamed(run.world(), "tile");
  double speed = 0, time = 0;
  run.observe(atEachStep([&](const ObjectState& state) {
    speed = state.bodies[tile].v_WB.norm();
    time = state.time_end;
  }));
  run.run();
  const double wanted = kGravity * (std::sin(kAbove * kRadian) - kFriction * std::cos(kAbove * kRadian)) * time;
  return {finding("speed after one second", 100 * (speed / wanted - 1), "% off", 5,
                  "g t (sin - mu cos) = " + number(1000 * wanted) + " mm/s")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "coulomb_stick";
  result.title = "A tile rests on a slope just below the angle of friction";
  result.source = "Coulomb's law on an incline; engines with soft or iterated friction creep at 0.1 to 7 mm/s.";
  result.oracle = "With friction 0.5 the tile stays at 26.5 degrees and slides at 27, in every direction.";
  result.scene = "coulomb_slope.xml";
  const std::vector<Method> methods{{kPresa, {}},
                                    {"20 iterations", {"dynamics/solver=iterative", "dynamics/iterations=20"}},
                                    {"pyramid friction", {"dynamics/friction=pyramid"}}};
  for (const double heading : {0.0, 22.5, 45.0}) {
    for (const bool above : {false, true}) {
      for (const Method& method : methods) {
        Trial trial;
        trial.parameters = {{"slope", number(above ? kAbove : kBelow) + " degrees"},
                            {"downhill", number(heading) + " degrees"}};
        trial.method = method.name;
        if (method.name == "20 iterations") trial.expected = above ? Verdict::kUnstable : Verdict::kDrift;
        if (method.name == "pyramid friction" && above && heading > 0) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return above ? slip(heading, method) : stick(heading, method); };
        trial.quick = above;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::coulomb_stick
