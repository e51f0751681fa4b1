#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/methods.h"

namespace presa::stability::hand_over {
namespace {

constexpr int kTimes = 6;                                      // hand-overs
constexpr double kHalf = 0.035, kRadius = 0.008;               // of the cube and the fingertips, as in the scene [m]
constexpr double kDepth = 0.002, kOpen = 0.003, kLift = 0.03;  // [m]
constexpr double kFirst = 1.2, kEach = 1, kMove = 0.3, kGravity = 9.81;  // [s, s, s, m/s^2]

double begin(int hand_over) { return kFirst + kEach * hand_over; }
double end() { return begin(kTimes) + 0.5; }

/// How far a hand (0 along x, 1 along y) has closed at a time, from 0 to 1. In each hand-over the other hand closes
/// before this one opens.
Ramp closed(int hand, double time) {
  Ramp all = hand == 0 ? ramp(time, 0.05, 0.35) : Ramp{};
  for (int i = 0; i < kTimes; ++i) {
    const bool receives = i % 2 != hand;
    const double at = begin(i) + (receives ? 0 : 0.4);
    const Ramp next = ramp(time, at, at + kMove);
    all.value += receives ? next.value : -next.value;
    all.rate += receives ? next.rate : -next.rate;
  }
  return all;
}

PrescribedFinger::State fingertip(std::size_t finger, double time) {
  const int hand = finger < 2 ? 0 : 1;
  const Vec3 nhat = (finger % 2 == 0 ? -1 : 1) * Vec3::Unit(hand);
  const Ramp close = closed(hand, time), lift = ramp(time, 0.4, 0.9);
  const double travel = kOpen + kDepth;
  return {(kHalf + kRadius + kOpen - travel * close.value) * nhat + Vec3(0, 0, kHalf + kLift * lift.value),
          -travel * close.rate * nhat + kLift * lift.rate * Vec3::UnitZ()};
}

std::vector<Finding> pass(double mass, double stiffness, const Method& method) {
  DeviceList fingers;
  for (std::size_t f = 0; f < 4; ++f) {
    fingers.push_back(std::make_unique<PrescribedFinger>([f](double time) { return fingertip(f, time); }));
  }
  const std::vector<std::string> sets{"body/cube/physics/mass=" + number(mass),
                                      "material/skin/stiffness=" + number(stiffness)};
  StudyRun run(specOf("hand_over.xml", sets + method, end()), std::move(fingers));
  const std::size_t cube = bodyNamed(run.world(), "cube");
  double height = 0, step = 0, tilt = 0, z = 0;
  std::vector<Vec3> last(4, Vec3::Zero());
  Curve shown{"height of the cube", {}, {}};
  run.observe([&](const HapticSample& sample) {
    const Pose& X_WB = sample.objects->bodies[cube].X_WB_end;
    z = X_WB.p.z();
    tilt = std::max(tilt, X_WB.q.angularDistance(Quat::Identity()));
    for (std::size_t f = 0; f < 4; ++f) {
      step = std::max(step, (sample.command.f_H_W[f] - last[f]).norm());
      last[f] = sample.command.f_H_W[f];
    }
    if (sample.tick.time > 1) height = std::max(height, kHalf + kLift - z);
    shown.x.push_back(sample.tick.time);
    shown.y.push_back(1000 * z);
  });
  run.run();

  // each hand takes the cube where the other one held it, and its springs give way once more
  const double sag = mass * kGravity / (2 * stiffness), wanted = kHalf + kLift - (kTimes + 1) * sag;
  Finding off =
      finding("height beside that of the springs", 1e6 * std::abs(z - wanted), "um", 2,
              "the cube sinks by m g / (2 k) = " + number(1e6 * sag) + " um whenever a hand takes its weight");
  off.plot_x = "time [s]";
  off.plot_y = "height of the cube [mm]";
  off.curves = {decimated(std::move(shown))};
  // a fingertip moves at 1.875 times its mean speed at most; a body whose springs get its weight at once moves at
  // g sqrt(m / (2 k)) at most, and sinks by 2 m g / (2 k)
  const double fastest = 1.875 * (kOpen + kDepth) / kMove + kGravity * std::sqrt(mass / (2 * stiffness));
  return {off,
          finding("height lost", 1e6 * height, "um", 1e6 * (kTimes + 2) * sag,
                  "it never falls: no more than if a hand let go at once the last time"),
          finding("tilt", 180 / std::numbers::pi * tilt, "deg", 0.1, "both hands hold it at its middle"),
          finding("force step", step, "N", stiffness * fastest * 0.001,
                  "k times the way of fingertip and cube in a tick: no force jumps")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "hand_over";
  result.title = "A cube goes from one hand to the other six times, in the air";
  result.source =
      "Statics of a body on springs that come and go: between two grasps a body must neither fall, nor jump to where "
      "the other hand holds it.";
  result.oracle = "The cube sinks by m g / (2 k) with each hand-over, and no force jumps.";
  result.scene = "hand_over.xml";
  for (const double stiffness : {2000.0, 10'000.0}) {
    for (const double mass : {0.01, 0.1, 0.3}) {
      for (const Method& method : {ours(), explicitCoupling()}) {
        Trial trial;
        trial.parameters = {{"stiffness", number(stiffness / 1000) + " N/mm"}, {"mass", number(mass * 1000) + " g"}};
        trial.method = method.name;
        if (!method.own()) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return pass(mass, stiffness, method); };
        trial.quick = mass > 0.05 && mass < 0.2;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::hand_over
