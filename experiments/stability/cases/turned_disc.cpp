#include <algorithm>
#include <cmath>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"

namespace presa::stability::turned_disc {
namespace {

constexpr double kDuration = 4, kJudged = 1;  // [s]; the last second is judged
constexpr double kSpin = 3, kStop = 2;        // of the stylus from 0.5 s on [rad/s]; it stops then [s]
constexpr double kPressed = 0.5, kTop = 0.010, kTip = 0.004, kDepth = 0.002;

/// Presses on the disc's middle, and turns about the vertical without yielding.
class TurningStylus final : public Device {
 public:
  static double angle(double time) { return kSpin * (std::clamp(time, kPressed, kStop) - kPressed); }
  FingerInput read(const Tick& tick) noexcept override {
    FingerInput input;
    const double down = std::min(1.0, tick.time / (kPressed / 2));
    input.p_WH = {0, 0, kTop + kTip + 0.002 - down * (0.002 + kDepth)};
    input.valid = input.oriented = true;
    input.q_WT = Quat(Eigen::AngleAxisd(angle(tick.time), Vec3::UnitZ()));
    input.w_WT = {0, 0, tick.time > kPressed && tick.time < kStop ? kSpin : 0};
    return input;
  }
  void write(const Wrench&, const Tick&) noexcept override {}
};

std::vector<Finding> turn(double mass, const Method& method) {
  DeviceList devices;
  devices.push_back(std::make_unique<TurningStylus>());
  const std::vector<std::string> sets{"body/disc/physics/mass=" + number(mass)};
  StudyRun run(specOf("turned_disc.xml", sets + method, kDuration), std::move(devices));
  const std::size_t disc = bodyNamed(run.world(), "disc");
  double fastest = 0, off = 0;
  Curve spin{"spin of the disc", {}, {}};
  run.observe([&](const HapticSample& sample) {
    const double now = sample.objects->bodies[disc].w_WB.z();
    spin.x.push_back(sample.tick.time);
    spin.y.push_back(now);
    if (sample.tick.time < kDuration - kJudged) return;
    fastest = std::max(fastest, std::abs(now));
    const Quat q = sample.objects->poseAt(static_cast<std::int32_t>(disc), sample.tick.time).q;
    const double lag = TurningStylus::angle(sample.tick.time) - 2 * std::atan2(q.z(), q.w());
    off = std::max(off, std::abs(std::remainder(lag, 2 * M_PI)));
  });
  run.run();
  Finding rest =
      finding("spin in the last second", fastest, "rad/s", 0.01, "the stylus stands still since two seconds");
  rest.plot_x = "time [s]";
  rest.plot_y = "spin [rad/s]";
  rest.curves.push_back(decimated(std::move(spin)));
  return {rest, finding("angle behind the stylus", off * 180 / M_PI, "degrees", 0.1,
                        "without load the torsional spring ends unwound; it never reaches its bound")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "turned_disc";
  result.title = "A stylus turns a disc on ice by torsional friction";
  result.source =
      "A flywheel on a rotational spring: h sqrt(k / I) is 3.5 for the disc of 1 g, above the limit of 2 of an "
      "explicit "
      "force.";
  result.oracle = "The disc turns with the stylus, and stands still where the stylus stops.";
  result.scene = "turned_disc.xml";
  for (const double mass : {0.001, 0.01, 0.1}) {
    for (const Method& method : {ours(), explicitCoupling()}) {
      if (!method.own() && mass > 0.001) continue;
      Trial trial;
      trial.parameters = {{"mass", number(mass * 1000) + " g"}};
      trial.method = method.name;
      if (!method.own()) trial.expected = Verdict::kUnstable;
      trial.run = [mass, method] { return turn(mass, method); };
      trial.quick = method.own() && mass < 0.05;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::turned_disc
