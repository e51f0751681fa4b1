#include <algorithm>
#include <cmath>

#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/methods.h"

namespace presa::stability::grasp_in_air {
namespace {

constexpr double kDuration = 5;
constexpr double kGravity = 9.81;

struct Grasp {
  double mass = 0, stiffness = 0;
  Method method;
  /// At least 2 mm, and enough to carry 1.5 times the weight at friction 1.
  double depth() const { return std::max(0.002, 1.5 * mass * kGravity / (2 * stiffness)); }
};

std::vector<Finding> hold(const Grasp& grasp) {
  const std::vector<std::string> sets{"body/cube/physics/mass=" + number(grasp.mass),
                                      "material/skin/stiffness=" + number(grasp.stiffness)};
  Pinch pinch;
  pinch.center = {0.0001, 0, 0.040};  // off the centre of the cube, and above it
  pinch.width = 0.07;
  pinch.depth = grasp.depth();
  pinch.lift = 0.03;
  StudyRun run(specOf("grasp_in_air.xml", sets + grasp.method, kDuration), pinchFingers(pinch));

  const double wanted = grasp.stiffness * pinch.depth;
  double worst = 0, low = wanted * 1e3, high = 0;
  Curve grip{"grip force", {}, {}};
  run.observe([&](const HapticSample& sample) {
    double force = 0;
    for (std::size_t f = 0; f < 2; ++f) {
      force += sample.contact.fingers[f].normal_force / 2;
      if (sample.tick.time < kDuration - 1) continue;
      const double normal = sample.contact.fingers[f].normal_force;
      worst = std::max(worst, std::abs(normal - wanted));
      low = std::min(low, normal);
      high = std::max(high, normal);
    }
    grip.x.push_back(sample.tick.time);
    grip.y.push_back(force);
  });
  run.run();

  const std::string oracle = "k depth = " + number(wanted) + " N from each finger";
  Finding error = finding("grip force error", 100 * worst / wanted, "%", 0.1, oracle);
  error.plot_x = "time [s]";
  error.plot_y = "mean normal force [N]";
  error.curves.push_back(decimated(std::move(grip)));
  return {error, finding("grip ripple in the last second", low > 0 ? 100 * (high - low) / wanted : NAN, "%", 0.1,
                         "ringing decays to nothing")};
}

/// Gauss-Seidel on two opposed contact rows converges by a factor m / (m + h^2 K) per sweep: stable from a mass of 0.85
/// h^2 K / 20 on, quiet from four times that mass on.
double minMassOfIterations(double stiffness) { return 4 * 0.85 * 0.005 * 0.005 * stiffness / 20; }

}  // namespace

Case make() {
  Case result;
  result.name = "grasp_in_air";
  result.title = "Two fingers hold a cube in the air";
  result.source =
      "Force of two springs of stiffness k on a free body between them; the bound h^2 K / 2 of explicit "
      "coupling is that of symplectic Euler.";
  result.oracle = "At rest each finger presses with k times its depth, for any mass.";
  result.scene = "grasp_in_air.xml";
  for (const double stiffness : {500.0, 2000.0, 10'000.0}) {
    for (const double mass : {0.001, 0.01, 0.1, 1.0}) {
      for (const Method& method : {ours(), explicitCoupling(), twentyIterations()}) {
        const Grasp grasp{mass, stiffness, method};
        Trial trial;
        trial.parameters = {{"stiffness", number(stiffness / 1000) + " N/mm"}, {"mass", number(mass * 1000) + " g"}};
        trial.method = method.name;
        // light bodies explode below h^2 K / 2 per axis; the ringing of heavy ones is undamped
        if (method.name == explicitCoupling().name) trial.expected = Verdict::kUnstable;
        // where the sweeps converge, a heavy body on soft springs keeps some ringing
        if (method.name == twentyIterations().name) {
          trial.expected = mass < 4 * minMassOfIterations(stiffness) ? Verdict::kUnstable : Verdict::kDrift;
        }
        trial.run = [grasp] { return hold(grasp); };
        trial.quick = stiffness > 5000 && mass < 0.02;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::grasp_in_air
