#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"

namespace presa::stability::spinning_coin {
namespace {

constexpr double kDuration = 12;                              // [s]
constexpr double kHalfThickness = 0.001, kFlat = 0.017;       // [m], [rad]: 1 degree
constexpr double kNever = std::numeric_limits<double>::infinity();

struct Fall {
  double flat_after = kNever;  // [s]
  double rise = 0;             // of the energy above its lowest value so far, in relation to that at the start
  Curve tilt;
};

Fall watch(double rate, double spin) {
  StudyRun run(specOf("spinning_coin.xml",
                      {"rates/dynamics=" + number(rate), "body/coin/angular_velocity=0 0 " + number(spin)}, kDuration));
  const std::size_t coin = bodyNamed(run.world(), "coin");
  const BodyInertia inertia = run.world().inertias[coin];
  const double weight = inertia.mass * run.world().scene.gravity.norm();
  Fall fall;
  fall.tilt.label = number(rate) + " Hz";
  double first = 0, lowest = kNever;
  run.observe(atEachStep([&](const ObjectState& state) {
    const BodyMotion& body = state.bodies[coin];
    const Vec3 w_B = body.X_WB_end.q.conjugate() * body.w_WB;
    const double energy = inertia.mass * body.v_WB.squaredNorm() / 2 + w_B.dot(inertia.inertia * w_B) / 2 +
                          weight * (body.X_WB_end.p.z() - kHalfThickness);
    if (lowest == kNever) first = energy;
    lowest = std::min(lowest, energy);
    fall.rise = std::max(fall.rise, (energy - lowest) / first);
    const Vec3 axis = body.X_WB_end.q * Vec3::UnitZ();
    const double tilt = std::atan2(axis.head<2>().norm(), std::abs(axis.z()));
    fall.flat_after = tilt > kFlat ? kNever : std::min(fall.flat_after, state.time_end);
    fall.tilt.x.push_back(state.time_end);
    fall.tilt.y.push_back(180 / std::numbers::pi * tilt);
  }));
  run.run();
  return fall;
}

std::vector<Finding> spinAndLieDown(double rate, double spin) {
  Fall fall = watch(rate, spin);
  Finding rise = finding("rise of the energy", 100 * fall.rise, "%", 0.2,
                         "friction and impacts only take energy; in relation to the energy at the start");
  rise.plot_x = "time [s]";
  rise.plot_y = "tilt of the coin [deg]";
  rise.curves = {decimated(std::move(fall.tilt))};
  return {rise, finding("lies flat after", fall.flat_after, "s", kDuration, "friction stops it within seconds")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "spinning_coin";
  result.title = "A coin of 24 x 2 mm is spun on its rim, then lies down";
  result.source =
      "The rim's lowest point runs around faster than the coin turns, and the axis leaves its cone at second order in "
      "the step: contacts that are linear within a step let the rim sink in and give the energy back.";
  result.oracle = "The energy never rises; the coin lies flat in the end.";
  result.scene = "spinning_coin.xml";
  for (const double rate : {200.0, 1000.0}) {
    for (const double spin : {20.0, 40.0, 80.0}) {
      Trial trial;
      trial.parameters = {{"step", number(1000 / rate) + " ms"}, {"spin", number(spin) + " rad/s"}};
      trial.method = kPresa;
      trial.expected = Verdict::kUnstable;  // open: a step must see the rim where it is at its end
      trial.run = [=] { return spinAndLieDown(rate, spin); };
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::spinning_coin
