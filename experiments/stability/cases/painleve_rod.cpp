#include <cmath>
#include <cstdio>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::painleve_rod {
namespace {

constexpr double kGravity = 9.81, kLength = 0.2, kThickness = 0.004, kMass = 0.02;  // as in the scene

struct Push {
  double friction = 0, lean_deg = 0;  ///< angle to the table
  double speed = 0;                   ///< of the rod; the lower end lies ahead when it is positive [m/s]
  Method method;
  double lean() const { return lean_deg * std::numbers::pi / 180; }
  double height() const { return (kLength * std::sin(lean()) + kThickness * std::cos(lean())) / 2; }
  /// Normal acceleration that a unit normal force with friction gives to the sliding end, times the mass; negative: the
  /// force that must keep the end out of the table pulls it in.
  double yielding() const {
    const double s = std::sin(lean()), c = std::cos(lean());
    return 1 + 3 * c * (c - std::copysign(friction, speed) * s);
  }
};

std::vector<std::string> setsOf(const Push& push) {
  char pos[64];
  std::snprintf(pos, sizeof pos, "body/rod/pos=0 0 %.17g", push.height());
  std::vector<std::string> sets{pos, "body/rod/euler_deg=0 " + number(push.lean_deg) + " 0",
                                "body/rod/velocity=" + number(push.speed) + " 0 0"};
  for (const std::string material : {"board", "chalk"}) {
    sets.push_back("material/" + material + "/friction/dynamic=" + number(push.friction));
    sets.push_back("material/" + material + "/friction/static=" + number(push.friction));
  }
  return sets;
}

/// In the paradox the end jams at once and the rod turns about it with the angular momentum that it had about this
/// point.
Finding jam(const Push& push) {
  constexpr double kStep = 0.005;  // [s]
  const double s = std::sin(push.lean()), c = std::cos(push.lean());
  const double behind = (kLength * c - kThickness * s) / 2;  // of the centre of mass
  const double inertia = (kLength * kLength + kThickness * kThickness) / 3;
  const double spin = push.speed * push.height() / inertia, wanted = spin - kStep * kGravity * behind / inertia;
  StudyRun run(specOf("painleve_rod.xml", setsOf(push) + push.method, 2 * kStep));
  double got = NAN;
  run.observe(atEachStep([&](const ObjectState& state) {
    if (std::isnan(got)) got = state.bodies[bodyNamed(run.world(), "rod")].w_WB.y();
  }));
  run.run();
  return finding("angular velocity once it has jammed, error", 100 * (got / wanted - 1), "%", 1,
                 "impact without collision: m v height over the inertia about the end, less one step of gravity");
}

std::vector<Finding> slide(const Push& push) {
  const double energy = push.speed * push.speed / 2 + kGravity * (push.height() - kThickness / 2);  // per mass
  Pile rod(specOf("painleve_rod.xml", setsOf(push) + push.method, 3), "rod");
  rod.run();
  std::vector<Finding> findings{
      rod.energy(kMass * energy, 0.1),
      rod.fastest(1.001 * std::sqrt(2 * energy), "no faster than all energy allows, of height and speed"),
      rod.restsWithin(3)};
  if (push.yielding() < 0) findings.push_back(jam(push));
  return findings;
}

}  // namespace

Case make() {
  Case result;
  result.name = "painleve_rod";
  result.title = "A rod is pushed and pulled over a table at friction beyond Painleve's paradox";
  result.source =
      "P. Painleve, C. R. Acad. Sci. 121 (1895), 112: from a friction of 4/3 on, rigid sliding has no solution or "
      "two at some angles; nature jams, a solver may explode.";
  result.oracle = "The energy never rises, no speed exceeds it, and the rod comes to rest.";
  result.scene = "painleve_rod.xml";
  for (const double friction : {0.5, 1.3, 2.0, 5.0}) {
    for (const double lean : {30.0, 60.0, 75.0}) {
      for (const double speed : {-2.0, 2.0}) {
        for (const Method& method : {ours(), twentyIterations()}) {
          const Push push{friction, lean, speed, method};
          Trial trial;
          trial.parameters = {
              {"friction", number(friction)},
              {"angle", number(lean) + " deg"},
              {"rod", std::string(speed > 0 ? "pushed" : "pulled") + (push.yielding() < 0 ? ", paradox" : "")}};
          trial.method = method.name;
          if (!method.own() && friction > 1)
            trial.expected = push.yielding() < 0 ? Verdict::kUnstable : Verdict::kDrift;
          trial.run = [push] { return slide(push); };
          trial.quick = method.own() && friction > 1.5;
          result.trials.push_back(std::move(trial));
        }
      }
    }
  }
  return result;
}

}  // namespace presa::stability::painleve_rod
