#include <cmath>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/domino_wave.h"
#include "experiments/stability/methods.h"

namespace presa::stability::domino_row {
namespace {

// as in the scene
constexpr int kDominoes = 30;
constexpr DominoRow kRow{0.048, 0.0075, 0.016, 0.1};
constexpr double kSpin = 6;
// dominoes between which the wave is steady
constexpr int kFrom = 12, kTo = 27;

/// Speed of the wave between the two dominoes [m/s], from the times at which each has turned by a given angle.
class Wave {
 public:
  void see(double time, double angle_from, double angle_to) {
    note(from_, time, angle_from);
    note(to_, time, angle_to);
  }
  double speed() const { return (kTo - kFrom) * (kRow.gap + kRow.thickness) / (to_.passed - from_.passed); }

 private:
  struct Mark {
    double time = 0, angle = 0, passed = NAN;
  };
  static void note(Mark& mark, double time, double angle) {
    const double half = kRow.gap / kRow.height / 2;
    if (mark.angle < half && angle >= half) {
      mark.passed = mark.time + (half - mark.angle) / (angle - mark.angle) * (time - mark.time);
    }
    mark = {time, angle, mark.passed};
  }
  Mark from_, to_;
};

double steadySpeed() {
  const std::vector<double> times = strikes(kRow, kDominoes, kSpin);
  return (kTo - kFrom) * (kRow.gap + kRow.thickness) / (times[kTo - 1] - times[kFrom - 1]);
}

std::vector<Finding> topple(double rate, const Method& method) {
  StudyRun run(specOf("domino_row.xml", std::vector<std::string>{"rates/dynamics=" + number(rate)} + method, 2));
  std::vector<std::size_t> dominoes;
  dominoes.reserve(kDominoes);
  for (int i = 0; i < kDominoes; ++i) dominoes.push_back(bodyNamed(run.world(), "d" + std::to_string(i)));
  const auto angle = [&](const ObjectState& state, int i) {
    const Vec3 up = state.bodies[dominoes[static_cast<std::size_t>(i)]].X_WB_end.q * Vec3::UnitZ();
    return std::atan2(up.x(), up.z());
  };
  Wave wave;
  Curve front{"dominoes that lean", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    wave.see(state.time_end, angle(state, kFrom), angle(state, kTo));
    int leaning = 0;
    for (int i = 0; i < kDominoes; ++i) leaning += angle(state, i) > 0.01 ? 1 : 0;
    front.x.push_back(state.time_end);
    front.y.push_back(leaning);
  }));
  run.run();

  const double wanted = steadySpeed();
  // a strike is seen within a step: up to a tenth of the step's share in the time that a domino takes
  const double bound = 10 / rate / ((kRow.gap + kRow.thickness) / wanted);
  Finding error = finding("speed of the wave, error", 100 * (wave.speed() / wanted - 1), "%", bound,
                          number(wanted) + " m/s: each domino turns about its edge and leans on the next");
  error.plot_x = "time [s]";
  error.plot_y = "dominoes that lean";
  error.curves = {decimated(std::move(front))};
  return {error};
}

}  // namespace

Case make() {
  Case result;
  result.name = "domino_row";
  result.title = "A row of thirty dominoes falls";
  result.source =
      "The steady wave in a row of dominoes that lean on each other, with friction: J. M. J. van Leeuwen, Am. J. "
      "Phys. 78 (2010), 721.";
  result.oracle = "The wave runs at 1.077 m/s, by equations of motion with one degree of freedom.";
  result.scene = "domino_row.xml";
  for (const double rate : {200.0, 500.0, 1000.0}) {
    for (const Method& method : {ours(), twentyIterations()}) {
      Trial trial;
      trial.parameters = {{"step", number(1000 / rate) + " ms"}};
      trial.method = method.name;
      if (!method.own() && rate > 400) trial.expected = Verdict::kDrift;
      trial.run = [=] { return topple(rate, method); };
      trial.quick = method.own() && rate < 300;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::domino_row
