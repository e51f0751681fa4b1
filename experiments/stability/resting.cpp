#include "experiments/stability/resting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/stability/bodies.h"

namespace presa::stability {
namespace {

constexpr double kRestSpeed = 2e-3;  // [m/s]

double radiusOf(const Body& body) {
  const auto* box = body.physics ? std::get_if<Box>(&body.physics->shape) : nullptr;
  return box != nullptr ? box->size.norm() / 2 : 0;
}

}  // namespace

double yieldBound(double load, double depth) { return 100 * 2.5e-6 * load / depth; }

std::vector<Finding> settle(const Resting& resting, DeviceList fingers) {
  StudyRun run(specOf(resting.scene, resting.sets, resting.duration), std::move(fingers));
  const std::size_t body = bodyNamed(run.world(), resting.body);
  const double radius = radiusOf(run.world().scene.bodies[body]);
  const double judged_from = resting.duration - 1;
  double speed = 0, error = 0;
  Curve shown{"speed of the body", {}, {}};
  run.observe([&](const HapticSample& sample) {
    const BodyMotion& motion = sample.objects->bodies[body];
    double now = motion.v_WB.norm() + motion.w_WB.norm() * radius;
    if (sample.objects->faults != 0) now = std::numeric_limits<double>::infinity();  // a frozen body is not at rest
    double force = 0;
    for (std::int32_t f = 0; f < sample.contact.count(); ++f) {
      force += sample.contact.fingers[static_cast<std::size_t>(f)].normal_force / sample.contact.count();
    }
    if (sample.tick.time >= judged_from) {
      speed = std::max(speed, now);
      error = std::max(error, std::abs(force - resting.force) / resting.force);
    }
    shown.x.push_back(sample.tick.time);
    shown.y.push_back(1000 * now);
  });
  run.run();

  Finding rest = finding("speed at rest", 1000 * speed, "mm/s", 1000 * kRestSpeed,
                         "no motion in the last second: v + |w| r of the body");
  rest.plot_x = "time [s]";
  rest.plot_y = "speed of the fastest point [mm/s]";
  rest.curves.push_back(decimated(std::move(shown)));
  return {rest, finding("force error", 100 * error, "%", resting.force_bound, resting.oracle)};
}

std::vector<Trial> restingTrials(
    const std::function<std::vector<Finding>(double mass, double stiffness, const Method&)>& run) {
  std::vector<Trial> trials;
  for (const double stiffness : {500.0, 2000.0, 10'000.0}) {
    for (const double mass : {0.001, 0.01, 0.1}) {
      for (const Method& method : {ours(), explicitCoupling(), twentyIterations()}) {
        Trial trial;
        trial.parameters = {{"stiffness", number(stiffness / 1000) + " N/mm"}, {"mass", number(mass * 1000) + " g"}};
        trial.method = method.name;
        if (!method.own()) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return run(mass, stiffness, method); };
        trial.quick = stiffness > 5000 && mass > 0.005 && mass < 0.05;
        trials.push_back(std::move(trial));
      }
    }
  }
  return trials;
}

}  // namespace presa::stability
