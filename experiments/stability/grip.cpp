#include "experiments/stability/grip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "experiments/stability/bodies.h"
#include "experiments/stability/held_body.h"

namespace presa::stability {
namespace {

constexpr double kMoving = 3.5;  // how long the body is moved [s]

/// The body on its springs, without its attachments.
HeldBody::Parameters parametersOf(const Carried& carried, const World& world, std::size_t body) {
  HeldBody::Parameters parameters;
  parameters.mass = world.inertias[body].mass;
  parameters.inertia = world.inertias[body].inertia.diagonal();
  parameters.stiffness = carried.stiffness;
  parameters.gravity = world.scene.gravity;
  parameters.fingertip = [&carried](std::size_t finger, double time) {
    return gripState(carried.grip, finger, time).p_WH;
  };
  return parameters;
}

/// The reference of the motion, from the body as it is when the motion begins.
HeldBody movingFrom(const Carried& carried, const World& world, const HapticSample& sample, std::size_t body) {
  HeldBody::Parameters parameters = parametersOf(carried, world, body);
  for (std::size_t f = 0; f < carried.grip.points.size(); ++f) {
    parameters.attachments.push_back(sample.contact.fingers[f].p_BP);
  }
  const BodyMotion& motion = sample.objects->bodies[body];
  return {std::move(parameters), sample.tick.time,
          sample.objects->poseAt(static_cast<std::int32_t>(body), sample.tick.time), motion.v_WB, motion.w_WB};
}

/// Normal forces of the lifted body at rest on the springs [N], from the geometry of the grip alone.
std::vector<double> restForces(const Carried& carried, const World& world, std::size_t body) {
  const Grip& grip = carried.grip;
  const Pose& X_WB = world.scene.bodies[body].X_WB;
  HeldBody::Parameters parameters = parametersOf(carried, world, body);
  for (std::size_t f = 0; f < grip.points.size(); ++f) {
    parameters.attachments.push_back(X_WB.inverseTimes(grip.points[f] + grip.radius * grip.normals[f]));
  }
  parameters.fingertip = [&grip](std::size_t finger, double) { return gripState(grip, finger, Grip::kMoveBegin).p_WH; };
  HeldBody rest(std::move(parameters), 0, {X_WB.p + grip.lift * Vec3::UnitZ(), X_WB.q}, Vec3::Zero(), Vec3::Zero());
  rest.relax(2);
  std::vector<double> forces;
  for (std::size_t f = 0; f < grip.points.size(); ++f) {
    forces.push_back(-rest.force(f).dot(rest.pose().q * (X_WB.q.conjugate() * grip.normals[f])));
  }
  return forces;
}

/// Mean squared distance between two poses [m^2], of the ends of three axes.
double squaredDistance(const Pose& a, const Pose& b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {-0.05, 0.05}) {
      const Vec3 p = end * Vec3::Unit(axis);
      sum += (a * p - b * p).squaredNorm() / 6;
    }
  }
  return sum;
}

}  // namespace

Grip twoHands(double reach, double half, double height) {
  Grip grip;
  for (const double x : {-reach, reach}) {
    for (const double side : {-1.0, 1.0}) {
      grip.points.emplace_back(x, side * half, height);
      grip.normals.emplace_back(side * Vec3::UnitY());
    }
  }
  return grip;
}

PrescribedFinger::State gripState(const Grip& grip, std::size_t finger, double time) {
  const Ramp close = ramp(time, Grip::kCloseBegin, Grip::kCloseEnd),
             lift = ramp(time, Grip::kLiftBegin, Grip::kLiftEnd);
  const double travel = grip.open + grip.depth;
  const Vec3& nhat = grip.normals[finger];
  PrescribedFinger::State state{grip.points[finger] + (grip.radius + grip.open - travel * close.value) * nhat +
                                    grip.lift * lift.value * Vec3::UnitZ(),
                                -travel * close.rate * nhat + grip.lift * lift.rate * Vec3::UnitZ()};
  if (grip.move && time > Grip::kMoveBegin) {
    const PrescribedFinger::State more = grip.move(finger, time - Grip::kMoveBegin);
    state.p_WH += more.p_WH;
    state.v_WH += more.v_WH;
  }
  return state;
}

DeviceList gripFingers(const Grip& grip) {
  DeviceList fingers;
  for (std::size_t f = 0; f < grip.points.size(); ++f) {
    fingers.push_back(std::make_unique<PrescribedFinger>([grip, f](double time) { return gripState(grip, f, time); }));
  }
  for (std::size_t f = 0; f < grip.waiting; ++f) {
    const Vec3 away(0.2 * static_cast<double>(f), 0, 1);
    fingers.push_back(std::make_unique<PrescribedFinger>([away](double) { return PrescribedFinger::State{away}; }));
  }
  return fingers;
}

PrescribedFinger::State shaken(const Vec3& direction, double frequency, double time) {
  const double omega = 2 * std::numbers::pi * frequency;
  const Ramp grow = ramp(time, 0, 0.5);
  return {direction * grow.value * std::sin(omega * time),
          direction * (grow.rate * std::sin(omega * time) + grow.value * omega * std::cos(omega * time))};
}

std::vector<Finding> carry(const Carried& carried) {
  const double end = Grip::kMoveBegin + kMoving;
  StudyRun run(specOf(carried.scene, carried.sets, end), gripFingers(carried.grip));
  if (run.world().scene.devices.size() != carried.grip.points.size() + carried.grip.waiting) {
    throw std::logic_error("not one finger for each device of " + carried.scene);
  }
  const std::size_t body = bodyNamed(run.world(), carried.body);
  const std::vector<double> forces = carried.forces.empty() ? restForces(carried, run.world(), body) : carried.forces;
  std::optional<HeldBody> reference;
  double force = 0, sum = 0;
  std::size_t count = 0;
  Curve error{"distance from the reference", {}, {}};
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.time < Grip::kMoveBegin) return;
    if (!reference) {
      reference.emplace(movingFrom(carried, run.world(), sample, body));
      for (std::size_t f = 0; f < forces.size(); ++f) {
        const double normal = sample.contact.fingers[f].normal_force;
        force = std::max(force, std::abs(normal / forces[f] - 1));
      }
    }
    reference->advance(sample.tick.time);
    const Pose X_WB = sample.objects->poseAt(static_cast<std::int32_t>(body), sample.tick.time);
    const double squared = squaredDistance(X_WB, reference->pose());
    sum += squared;
    ++count;
    error.x.push_back(sample.tick.time);
    error.y.push_back(1000 * std::sqrt(squared));
  });
  run.run();

  Finding distance = finding("distance from the reference", 1000 * std::sqrt(sum / static_cast<double>(count)), "mm",
                             carried.bound, "RMS against the springs alone, integrated at 10 us");
  distance.plot_x = "time [s]";
  distance.plot_y = "distance from the reference [mm]";
  distance.curves.push_back(decimated(std::move(error)));
  return {finding("normal force error at rest", 100 * force, "%", 0.1, carried.oracle), distance};
}

std::vector<Trial> carriedTrials(
    const std::function<std::vector<Finding>(double mass, double stiffness, int axis, const Method&)>& run) {
  std::vector<Trial> trials;
  for (const double stiffness : {2000.0, 10'000.0}) {
    for (const double mass : {0.01, 0.1}) {
      for (const int axis : {0, 1, 2}) {
        for (const Method& method : {ours(), explicitCoupling()}) {
          Trial trial;
          trial.parameters = {{"stiffness", number(stiffness / 1000) + " N/mm"},
                              {"mass", number(mass * 1000) + " g"},
                              {"along", std::string(1, "xyz"[axis])}};
          trial.method = method.name;
          if (!method.own()) trial.expected = Verdict::kUnstable;
          trial.run = [=] { return run(mass, stiffness, axis, method); };
          trial.quick = stiffness > 5000 && mass < 0.05;
          trials.push_back(std::move(trial));
        }
      }
    }
  }
  return trials;
}

}  // namespace presa::stability
