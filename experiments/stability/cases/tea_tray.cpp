#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"
#include "experiments/stability/methods.h"

namespace presa::stability::tea_tray {
namespace {

// as in the scene [m]
constexpr double kHalf = 0.06, kReach = 0.19, kHeight = 0.062;
constexpr double kAmplitude = 0.01, kFrequency = 2;  // [m, Hz]
constexpr double kEnd = 5.5, kWindow = 0.1;          // [s]

struct Service {
  std::vector<std::size_t> bodies;
  std::vector<double> masses;
};

Service serviceOf(const World& world) {
  Service service;
  for (const char* name : {"tray", "pot", "cup_left", "cup_right"}) {
    service.bodies.push_back(bodyNamed(world, name));
    service.masses.push_back(world.inertias[service.bodies.back()].mass);
  }
  return service;
}

/// What Newton's second law says of the four bodies together: the fingers' impulse beside their momentum and weight.
struct Balance {
  double time = 0;
  Vec3 felt = Vec3::Zero();      // impulse on the fingers so far [N s]
  Vec3 momentum = Vec3::Zero();  // [N s]
};

std::vector<Finding> carryTray(int axis, const Method& method) {
  Grip grip = twoHands(kReach, kHalf, kHeight);
  grip.depth = 0.003;
  grip.move = [axis](std::size_t, double time) { return shaken(kAmplitude * Vec3::Unit(axis), kFrequency, time); };
  StudyRun run(specOf("tea_tray.xml", std::vector<std::string>{} + method, kEnd), gripFingers(grip));
  const Service service = serviceOf(run.world());
  const Vec3 weight = run.world().scene.gravity * std::accumulate(service.masses.begin(), service.masses.end(), 0.0);
  std::vector<Balance> balances;
  Balance now;
  double worst = 0, step = 0, slid = 0;
  std::vector<Vec3> last(4, Vec3::Zero()), place(4, Vec3::Zero());
  Curve shown{"force of the four fingers", {}, {}};
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.time < 1) return;
    now.time = sample.tick.time;
    now.momentum.setZero();
    Vec3 force = Vec3::Zero();
    for (std::size_t i = 0; i < service.bodies.size(); ++i) {
      const auto body = static_cast<std::int32_t>(service.bodies[i]);
      now.momentum += service.masses[i] * sample.objects->bodies[service.bodies[i]].v_WB;
      const Pose X_WT = sample.objects->poseAt(static_cast<std::int32_t>(service.bodies[0]), now.time);
      const Vec3 p = X_WT.inverseTimes(sample.objects->poseAt(body, now.time).p);
      if (balances.empty()) place[i] = p;
      slid = std::max(slid, (p - place[i]).norm());
    }
    for (std::size_t f = 0; f < 4; ++f) {
      const Vec3& on_finger = sample.contact.fingers[f].f_H_W;
      if (!balances.empty()) step = std::max(step, (on_finger - last[f]).norm());
      last[f] = on_finger;
      force += on_finger;
    }
    balances.push_back(now);
    now.felt += sample.tick.period * force;
    const auto ticks = static_cast<std::size_t>(std::lround(kWindow / sample.tick.period));
    if (balances.size() > ticks) {
      const Balance &end = balances.back(), &begin = balances[balances.size() - 1 - ticks];
      const Vec3 off = end.momentum - begin.momentum + (end.felt - begin.felt) - (end.time - begin.time) * weight;
      worst = std::max(worst, off.norm() / (kWindow * weight.norm()));
    }
    shown.x.push_back(now.time);
    shown.y.push_back(-force.z());
  });
  run.run();

  Finding felt = finding("force felt beside Newton's law", 100 * worst, "%", 1,
                         "change of the four bodies' momentum less their weight, over any 0.1 s");
  felt.plot_x = "time [s]";
  felt.plot_y = "force of the four fingers upward [N]";
  felt.curves = {decimated(std::move(shown))};
  // k times the way of the tray in a tick, at the fastest, twice: the springs give way by some of it
  const double fastest = 2 * std::numbers::pi * kFrequency * kAmplitude;
  std::vector<Finding> findings{
      finding("force step", step, "N", 2 * 3000 * fastest * 0.001, "no force jumps when bodies change hands"),
      finding("sliding on the tray", 1000 * slid, "mm", 0.1, "friction carries four times this acceleration")};
  // four bodies are too many for three: the dynamics move them, and say velocities at the end of a step of 5 ms
  if (run.world().scene.dynamics.max_held >= service.bodies.size()) findings.insert(findings.begin(), felt);
  return findings;
}

}  // namespace

Case make() {
  Case result;
  result.name = "tea_tray";
  result.title = "Two hands carry a tray with a pot and two cups, and shake it at 2 Hz";
  result.source =
      "Harwin and Barrow, section 6: haptic rendering must consider the energy coupling through all objects connected "
      "to the device, for example a tray that carries a tea service.";
  result.oracle = "Newton's second law for the tray and all that stands on it; nothing slides, and no force jumps.";
  result.scene = "tea_tray.xml";
  for (const int axis : {0, 1, 2}) {
    for (const std::size_t max_held : {4, 3}) {
      Trial trial;
      trial.parameters = {{"along", std::string(1, "xyz"[axis])}, {"held together", std::to_string(max_held)}};
      trial.method = kPresa;
      trial.run = [=] { return carryTray(axis, hapticRate(max_held)); };
      trial.quick = axis == 1;
      result.trials.push_back(std::move(trial));
    }
    Trial explicitly;
    explicitly.parameters = {{"along", std::string(1, "xyz"[axis])}, {"held together", "4"}};
    explicitly.method = explicitCoupling().name;
    explicitly.expected = Verdict::kUnstable;
    explicitly.run = [=] { return carryTray(axis, explicitCoupling()); };
    result.trials.push_back(std::move(explicitly));
  }
  return result;
}

}  // namespace presa::stability::tea_tray
