#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"

namespace presa::stability::pendulum {
namespace {

constexpr double kDuration = 60, kLength = 0.3, kGravity = 9.81, kStart = std::numbers::pi / 3;

/// Period of a thin rod, with its breadth in the moment of inertia: 4 sqrt(I / m g r) K(sin(start / 2)), K by the
/// arithmetic-geometric mean.
double exactPeriod() {
  constexpr double kBreadth = 0.02, kArm = kLength / 2;
  const double inertia = (kBreadth * kBreadth + kLength * kLength) / 12 + kArm * kArm;  // about the hinge, per mass
  double a = 1, b = std::cos(kStart / 2);
  for (int i = 0; i < 30; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * std::numbers::pi / a * std::sqrt(inertia / (kGravity * kArm));
}

/// Top of the parabola through three equally spaced values.
double peakOf(double a, double b, double c) {
  const double bend = a - 2 * b + c;
  return bend < 0 ? b - (c - a) * (c - a) / (8 * bend) : b;
}

std::vector<Finding> swing(const Method& method) {
  StudyRun run(specOf("pendulum.xml", std::vector<std::string>{} + method, kDuration));
  const std::size_t rod = bodyNamed(run.world(), "rod");
  std::vector<double> crossings, x, z;
  Curve height{"height of the turning points", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    const Vec3 p = state.bodies[rod].X_WB_end.p;
    x.push_back(p.x());
    z.push_back(p.z());
    const std::size_t n = x.size();
    if (n < 3) return;
    if (x[n - 2] < 0 && x[n - 1] >= 0)
      crossings.push_back(state.time_end - (state.time_end - state.time_begin) * x[n - 1] / (x[n - 1] - x[n - 2]));
    if (z[n - 2] > z[n - 3] && z[n - 2] >= z[n - 1]) {
      height.x.push_back(state.time_end);
      height.y.push_back(1000 * peakOf(z[n - 3], z[n - 2], z[n - 1]));
    }
  }));
  run.run();
  const double swings = static_cast<double>(crossings.size()) - 1;
  const double period = swings > 0 ? (crossings.back() - crossings.front()) / swings : NAN;
  const auto [low, high] = std::ranges::minmax(height.y.empty() ? std::vector<double>{NAN} : height.y);
  const double rise = 1000 * kLength / 2 * (1 - std::cos(kStart));
  Finding energy = finding("change of the swing's energy", 100 * (high - low) / rise, "%", 0.01,
                           "gravity and a hinge without friction keep it");
  energy.plot_x = "time [s]";
  energy.plot_y = "height of the turning points [mm]";
  energy.curves = {decimated(std::move(height))};
  return {energy, finding("error of the period", 100 * (period / exactPeriod() - 1), "%", 0.05,
                          "elliptic integral: " + number(exactPeriod()) + " s")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "pendulum";
  result.title = "A rod swings from a hinge for a minute";
  result.source = "The physical pendulum at 60 degrees; its period is a complete elliptic integral of the first kind.";
  result.oracle = "Period and height of the swing stay as they are.";
  result.scene = "pendulum.xml";
  for (const Method& method : {ours(), Method{"direct", {"dynamics/solver=direct"}}, twentyIterations()}) {
    Trial trial;
    trial.method = method.name;
    trial.parameters = {{"start", "60 deg"}};
    trial.expected = method.own() ? Verdict::kStable : Verdict::kUnstable;  // the engine's joints lose energy
    trial.run = [method] { return swing(method); };
    trial.quick = method.own();
    result.trials.push_back(std::move(trial));
  }
  return result;
}

}  // namespace presa::stability::pendulum
