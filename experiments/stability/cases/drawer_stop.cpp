#include <algorithm>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"
#include "experiments/stability/methods.h"

namespace presa::stability::drawer_stop {
namespace {

constexpr double kUpper = 0.05, kBeyond = 0.008, kDuration = 4;  // stop of the scene, pulled beyond it [m]; [s]

/// The hand pulls at `speed` until it is kBeyond past the stop.
std::vector<Finding> pull(double speed, double stiffness, const Method& method) {
  Grip grip;
  for (const double side : {-1.0, 1.0}) {
    grip.points.emplace_back(side * 0.012, 0, 0);
    grip.normals.emplace_back(side * Vec3::UnitX());
  }
  grip.depth = 12 / stiffness;
  grip.lift = 0;
  grip.move = [speed](std::size_t, double time) {
    const double way = kUpper + kBeyond, all = 2 * way / speed;
    const Ramp along = ramp(time, 0, all);
    return PrescribedFinger::State{Vec3(0, -way * along.value, 0), Vec3(0, -way * along.rate, 0)};
  };
  StudyRun run(specOf("drawer_stop.xml",
                      std::vector<std::string>{"material/oak/stiffness=" + number(stiffness)} + method, kDuration),
               gripFingers(grip));
  const std::size_t drawer = bodyNamed(run.world(), "drawer");
  const double start = run.world().scene.bodies[drawer].X_WB.p.y();
  double beyond = 0, end = 0;
  const StudyRun::Observer body = atEachStep([&](const ObjectState& state) {
    end = start - state.bodies[drawer].X_WB_end.p.y();
    beyond = std::max(beyond, end - kUpper);
  });
  std::vector<Vec3> before(2, Vec3::Zero());
  double step = 0;
  Curve force{"pull of one finger", {}, {}};
  run.observe([&](const HapticSample& sample) {
    body(sample);
    for (std::size_t f = 0; f < 2; ++f) {
      const Vec3 now = sample.contact.fingers[f].f_H_W;
      if (sample.tick.time > Grip::kMoveBegin) step = std::max(step, (now - before[f]).norm());
      before[f] = now;
    }
    force.x.push_back(sample.tick.time);
    force.y.push_back(before[0].y());
  });
  run.run();
  Finding slew =
      finding("largest step of a finger's force in a tick", step, "N", 1, "slew limit of the device: 1000 N/s");
  slew.plot_x = "time [s]";
  slew.plot_y = "force of one finger along the drawer [N]";
  slew.curves = {decimated(std::move(force))};
  return {slew, finding("way beyond the stop", 1000 * beyond, "mm", 0.01, "a stop is rigid"),
          finding("drawer left in", 1000 * (kUpper - end), "mm", 0.01, "the hand pulls it to the stop")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "drawer_stop";
  result.title = "Two fingers pull a drawer into its stop";
  result.source = "A stop of a joint under a hand that moves on: a rigid impact between two haptic ticks.";
  result.oracle = "The drawer stands at its stop, and no finger feels a step above the slew limit.";
  result.scene = "drawer_stop.xml";
  for (const double speed : {0.1, 0.4}) {
    for (const double stiffness : {1000.0, 2000.0}) {
      for (const Method& method : {ours(), hapticRate()}) {
        Trial trial;
        trial.parameters = {{"mean speed", number(speed) + " m/s"},
                            {"stiffness", number(stiffness / 1000) + " N/mm"},
                            {"coupling", couplingOf(method)}};
        trial.method = method.name;
        trial.run = [=] { return pull(speed, stiffness, method); };
        trial.quick = speed > 0.2;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::drawer_stop
