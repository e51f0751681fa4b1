#include <algorithm>
#include <cmath>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"

namespace presa::stability::rolling {
namespace {

constexpr double kDuration = 4;
constexpr double kForce = 150, kPlateMass = 10, kBallMass = 1, kBalls = 25, kGravity = 9.81;
constexpr double kGroundFriction = 0.4;

/// Closed-form accelerations of plate and balls along the force: sliding friction of the ground, rolling balls.
struct Answer {
  double ground = kGroundFriction * (kPlateMass + kBalls * kBallMass) * kGravity;
  double per_ball = (kForce - ground) / kPlateMass / (3.5 / kBallMass + kBalls / kPlateMass);
  double plate = (kForce - ground - kBalls * per_ball) / kPlateMass;
  double ball = per_ball / kBallMass;
};

std::vector<Finding> drag(const Vec3& direction, bool pyramid) {
  char force[120];
  std::snprintf(force, sizeof force, "body/plate/physics/force=%.17g %.17g 0", kForce * direction.x(),
                kForce * direction.y());
  std::vector<std::string> sets{force};
  if (pyramid) sets.emplace_back("dynamics/friction=pyramid");
  StudyRun run(specOf("rolling.xml", sets, kDuration));
  const std::size_t plate = bodyNamed(run.world(), "plate"), ball = bodyNamed(run.world(), "ball_00");
  const Answer answer;
  double sum = 0;
  int steps = 0;
  Curve speed{"plate", {}, {}}, wanted{"closed form", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    const double t = state.time_end;
    sum += (state.bodies[plate].v_WB - answer.plate * t * direction).squaredNorm() +
           (state.bodies[ball].v_WB - answer.ball * t * direction).squaredNorm();
    ++steps;
    speed.x.push_back(t);
    speed.y.push_back(state.bodies[plate].v_WB.dot(direction));
    wanted.x.push_back(t);
    wanted.y.push_back(answer.plate * t);
  }));
  run.run();

  Finding error = finding("mean squared velocity error", sum / steps, "(m/s)^2", 1e-6,
                          "plate " + number(answer.plate) + " m/s^2, ball " + number(answer.ball) + " m/s^2");
  error.plot_x = "time [s]";
  error.plot_y = "speed of the plate [m/s]";
  error.curves = {decimated(std::move(speed)), decimated(std::move(wanted))};
  return {error};
}

}  // namespace

Case make() {
  Case result;
  result.name = "rolling";
  result.title = "A plate is dragged away under 25 balls";
  result.source =
      "SimBenchmark, task \"rolling\": 150 N on the plate, only 9 % more than the friction of the ground, 1 ms "
      "steps; its published error of the engine alone is 3.14 (m/s)^2 along (0.5, 0.87).";
  result.oracle = "Closed form: the plate slides, the balls roll; velocities of plate and first ball over 4 s.";
  result.scene = "rolling.xml";
  for (const bool diagonal : {false, true}) {
    for (const bool pyramid : {false, true}) {
      Trial trial;
      trial.parameters = {{"force along", diagonal ? "(0.5, 0.87)" : "y"}};
      trial.method = pyramid ? "pyramid friction" : kPresa;
      if (pyramid && diagonal) trial.expected = Verdict::kUnstable;
      const Vec3 direction = diagonal ? Vec3(0.5, std::sqrt(0.75), 0) : Vec3(0, 1, 0);
      trial.run = [=] { return drag(direction, pyramid); };
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::rolling
