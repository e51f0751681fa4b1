#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/held_body.h"
#include "experiments/stability/methods.h"

namespace presa::stability::grasp_shaken {
namespace {

constexpr double kEdge = 0.07;                              // [m]
constexpr double kAmplitude = 0.015, kFrequency = 3;        // [m, Hz]
constexpr double kShakeBegin = 1.5, kFade = 0.5, kEnd = 5;  // [s]; the amplitude grows over kFade
constexpr double kGravity = 9.81;

struct Shake {
  double mass = 0, stiffness = 0;
  int axis = 0;
  Method method;
};

Pinch pinchOf(const Shake& shake) {
  constexpr double kOmega = 2 * std::numbers::pi * kFrequency;
  Pinch pinch;
  pinch.center = {0.0001, 0, 0.040};
  pinch.width = kEdge;
  // 1.5 times the force that weight and shaking need at friction 1
  const double load = shake.mass * (kGravity + kAmplitude * kOmega * kOmega);
  pinch.depth = std::max(0.002, 1.5 * load / (2 * shake.stiffness));
  pinch.lift = 0.05;
  pinch.sway = [axis = shake.axis, start = kShakeBegin - pinch.lift_end](double time) {
    const double t = time - start;
    PrescribedFinger::State state;
    if (t <= 0) return state;
    const Ramp grow = ramp(t, 0, kFade);
    state.p_WH[axis] = kAmplitude * grow.value * std::sin(kOmega * t);
    state.v_WH[axis] = kAmplitude * (grow.rate * std::sin(kOmega * t) + grow.value * kOmega * std::cos(kOmega * t));
    return state;
  };
  return pinch;
}

/// The reference, starting from the body at rest before it is shaken.
HeldBody referenceOf(const Shake& shake, const Pinch& pinch, const HapticSample& sample, std::size_t body) {
  HeldBody::Parameters parameters;
  parameters.mass = shake.mass;
  parameters.inertia = Vec3::Constant(shake.mass * kEdge * kEdge / 6);
  parameters.stiffness = shake.stiffness;
  parameters.gravity = {0, 0, -kGravity};
  for (std::size_t f = 0; f < 2; ++f) parameters.attachments.push_back(sample.contact.fingers[f].p_BP);
  parameters.fingertip = [pinch](std::size_t finger, double time) {
    return pinchState(pinch, finger == 0 ? -1 : 1, time).p_WH;
  };
  const BodyMotion& motion = sample.objects->bodies[body];
  return {std::move(parameters), sample.tick.time,
          sample.objects->poseAt(static_cast<std::int32_t>(body), sample.tick.time), motion.v_WB, motion.w_WB};
}

/// Mean squared distance of the eight corners between two poses [m^2].
double squaredDistance(const Pose& a, const Pose& b) {
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = kEdge / 2 * Vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    sum += (a * p - b * p).squaredNorm() / 8;
  }
  return sum;
}

std::vector<Finding> follow(const Shake& shake) {
  const std::vector<std::string> sets{"body/cube/physics/mass=" + number(shake.mass),
                                      "material/skin/stiffness=" + number(shake.stiffness)};
  const Pinch pinch = pinchOf(shake);
  StudyRun run(specOf("grasp_shaken.xml", sets + shake.method, kEnd), pinchFingers(pinch));
  const std::size_t cube = bodyNamed(run.world(), "cube");

  std::optional<HeldBody> reference;
  double sum = 0;
  std::size_t count = 0;
  Curve error{"distance from the reference", {}, {}};
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.time < kShakeBegin) return;
    if (!reference) reference.emplace(referenceOf(shake, pinch, sample, cube));
    reference->advance(sample.tick.time);
    const Pose X_WB = sample.objects->poseAt(static_cast<std::int32_t>(cube), sample.tick.time);
    const double squared = squaredDistance(X_WB, reference->pose());
    sum += squared;
    ++count;
    error.x.push_back(sample.tick.time);
    error.y.push_back(1000 * std::sqrt(squared));
  });
  run.run();

  Finding distance = finding("distance from the reference", 1000 * std::sqrt(sum / static_cast<double>(count)), "mm",
                             0.2, "RMS over time and corners against the springs alone, integrated at 10 us");
  distance.plot_x = "time [s]";
  distance.plot_y = "distance from the reference [mm]";
  distance.curves.push_back(decimated(std::move(error)));
  return {distance};
}

}  // namespace

Case make() {
  Case result;
  result.name = "grasp_shaken";
  result.title = "Two fingers shake a cube at 3 Hz, 15 mm to each side";
  result.source =
      "Equations of motion of a rigid body on two springs whose far ends move as prescribed; nothing of the engine, "
      "its "
      "solver or the haptic rendering takes part.";
  result.oracle = "The body follows these equations, integrated by symplectic Euler at 10 us.";
  result.scene = "grasp_shaken.xml";
  for (const double stiffness : {2000.0, 10'000.0}) {
    for (const double mass : {0.001, 0.01, 0.1, 0.5}) {
      for (const int axis : {0, 1, 2}) {
        for (const Method& method : {ours(), explicitCoupling(), twentyIterations()}) {
          Trial trial;
          trial.parameters = {{"stiffness", number(stiffness / 1000) + " N/mm"},
                              {"mass", number(mass * 1000) + " g"},
                              {"along", std::string(1, "xyz"[axis])}};
          trial.method = method.name;
          if (!method.own()) trial.expected = Verdict::kUnstable;
          trial.run = [shake = Shake{mass, stiffness, axis, method}] { return follow(shake); };
          trial.quick = stiffness > 5000 && mass < 0.002;
          result.trials.push_back(std::move(trial));
        }
      }
    }
  }
  return result;
}

}  // namespace presa::stability::grasp_shaken
