#include <algorithm>
#include <cmath>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"

namespace presa::stability::free_rotation {
namespace {

constexpr double kDuration = 20;
const Vec3 kInertia(1e-5, 2e-5, 2.5e-5);  // [kg m^2], of the scene's box

/// Counts sign changes of the spin about the middle axis, in body axes.
struct Flips {
  int count = 0;
  double last = 0;
  void see(double w_middle) {
    if (w_middle * last < 0) ++count;
    if (w_middle != 0) last = w_middle;
  }
};

Vec3 eulerRate(const Vec3& w) { return kInertia.cwiseInverse().cwiseProduct(-w.cross(kInertia.cwiseProduct(w))); }

/// Reference: Euler's equations, integrated by classical Runge-Kutta in steps of 10 us, sampled every 5 ms.
struct Reference {
  Flips flips;
  Curve spin{"reference", {}, {}};
  explicit Reference(Vec3 w) {
    constexpr double kStep = 1e-5;
    constexpr int kPerSample = 500;
    const int samples = static_cast<int>(std::lround(kDuration / (kStep * kPerSample)));
    for (int i = 0; i < samples; ++i) {
      for (int k = 0; k < kPerSample; ++k) {
        const Vec3 k1 = eulerRate(w), k2 = eulerRate(w + kStep / 2 * k1), k3 = eulerRate(w + kStep / 2 * k2);
        const Vec3 k4 = eulerRate(w + kStep * k3);
        w += kStep / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
      flips.see(w.y());
      spin.x.push_back((i + 1) * kStep * kPerSample);
      spin.y.push_back(w.y());
    }
  }
};

std::vector<Finding> tumble(const std::string& rotation, double rate) {
  StudyRun run(
      specOf("free_rotation.xml", {"dynamics/rotation=" + rotation, "rates/dynamics=" + number(rate)}, kDuration));
  const Vec3 w0 = run.world().scene.bodies[0].w_WB;
  const double energy0 = 0.5 * w0.dot(kInertia.cwiseProduct(w0));
  const Vec3 momentum0 = kInertia.cwiseProduct(w0);
  Reference reference(w0);
  Flips flips;
  double energy_error = 0, momentum_error = 0;
  Curve spin{"spin about the middle axis", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    const Quat& q_WB = state.bodies[0].X_WB_end.q;
    const Vec3 w_B = q_WB.conjugate() * state.bodies[0].w_WB;
    const Vec3 momentum_W = q_WB * kInertia.cwiseProduct(w_B);
    energy_error = std::max(energy_error, std::abs(0.5 * w_B.dot(kInertia.cwiseProduct(w_B)) / energy0 - 1));
    momentum_error = std::max(momentum_error, (momentum_W - momentum0).norm() / momentum0.norm());
    flips.see(w_B.y());
    spin.x.push_back(state.time_end);
    spin.y.push_back(w_B.y());
  }));
  run.run();

  const std::string right = std::to_string(reference.flips.count);
  Finding count = finding("flips too many or too few", std::abs(flips.count - reference.flips.count), "", 0,
                          right + " flips by a reference in steps of 10 us");
  count.plot_x = "time [s]";
  count.plot_y = "spin about the middle axis [rad/s]";
  count.curves = {decimated(std::move(spin)), decimated(std::move(reference.spin))};
  return {count, finding("relative energy error", energy_error, "", 1e-6, "no torque, no change of energy"),
          finding("relative angular momentum error", momentum_error, "", 1e-6, "no torque, no change of momentum")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "free_rotation";
  result.title = "A box spins about its middle axis";
  result.source =
      "Dzhanibekov's tumbling nut: moments of inertia 1, 2 and 2.5e-5 kg m2, spin (0.01, 20, 0.01) rad/s, 20 s.";
  result.oracle =
      "Nine flips, as a Runge-Kutta integration of Euler's equations in steps of 10 us finds; energy and "
      "angular momentum stay constant.";
  result.scene = "free_rotation.xml";
  const std::vector<std::pair<std::string, std::string>> methods{{"exact", kPresa},
                                                                 {"engine", "engine's rotation"},
                                                                 {"none", "no gyroscopic term"},
                                                                 {"euler", "one Euler step"},
                                                                 {"matrix", "R (I + S dt)"}};
  for (const double rate : {200.0, 1000.0}) {
    for (const auto& [rotation, method] : methods) {
      Trial trial;
      trial.parameters = {{"step", number(1000 / rate) + " ms"}};
      trial.method = method;
      if (method != kPresa) trial.expected = Verdict::kUnstable;
      trial.run = [=] { return tumble(rotation, rate); };
      trial.quick = rate < 500;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::free_rotation
