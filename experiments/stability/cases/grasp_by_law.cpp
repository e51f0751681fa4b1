#include <algorithm>
#include <cmath>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/methods.h"

namespace presa::stability::grasp_by_law {
namespace {

constexpr double kDuration = 5, kJudged = 1;  // [s]; the last second is judged
constexpr double kGravity = 9.81, kStiffness = 2000, kDepth = 0.002;

/// A friction law and its settings of a <friction>.
struct Law {
  std::string name;
  std::vector<std::string> sets;
};

std::vector<Law> laws() {
  const std::string friction = "material/skin/friction/";
  return {
      {"cone", {}},
      {"viscous", {friction + "viscous/damping=20"}},
      {"Stribeck", {friction + "stribeck/speed=0.02", friction + "stribeck/viscosity=2"}},
      {"Dahl", {friction + "dahl/stiffness=2000"}},
      {"LuGre",
       {friction + "lugre/stiffness=2000", friction + "lugre/speed=0.02", friction + "lugre/damping=1",
        friction + "lugre/viscosity=1"}},
      {"membrane", {friction + "membrane/stiffness=1000"}},
      {"anisotropic", {friction + "anisotropic/grain=0 1 0", friction + "anisotropic/across=0.7"}},
  };
}

std::vector<Finding> hold(const Law& law, double mass, const Method& method) {
  // at the dynamics' rate, where a law's row is the only thing that holds; some laws have haptic_rate by default
  std::vector<std::string> sets{"body/cube/physics/mass=" + number(mass),
                                "material/skin/stiffness=" + number(kStiffness), "dynamics/coupling=soft"};
  sets.insert(sets.end(), law.sets.begin(), law.sets.end());
  Pinch pinch;
  pinch.center = {0, 0, 0.035};
  pinch.width = 0.07;
  pinch.depth = kDepth;
  pinch.lift = 0.03;
  StudyRun run(specOf("grasp_in_air.xml", sets + method, kDuration), pinchFingers(pinch));
  const std::size_t cube = bodyNamed(run.world(), "cube");

  const double weight = mass * kGravity;
  double worst = 0, first = NAN, last = NAN;
  Curve carried{"vertical force", {}, {}};
  run.observe([&](const HapticSample& sample) {
    double force = 0;
    for (std::size_t f = 0; f < 2; ++f) force -= sample.contact.fingers[f].f_H_W.z();
    carried.x.push_back(sample.tick.time);
    carried.y.push_back(force);
    if (sample.tick.time < kDuration - kJudged) return;
    worst = std::max(worst, std::abs(force - weight));
    last = sample.objects->poseAt(static_cast<std::int32_t>(cube), sample.tick.time).p.z();
    if (std::isnan(first)) first = last;
  });
  run.run();

  Finding error = finding("vertical force error", 100 * worst / weight, "%", 0.5,
                          "both fingers together carry m g = " + number(weight) + " N");
  error.plot_x = "time [s]";
  error.plot_y = "vertical force [N]";
  error.curves.push_back(decimated(std::move(carried)));
  return {error, finding("creep in the last second", 1000 * std::abs(last - first), "mm", 0.01,
                         "below its static coefficient no law slides under a constant load")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "grasp_by_law";
  result.title = "Two fingers hold a cube by every friction law";
  result.source =
      "Statics of a body between two fingers; the laws differ in how they yield and slide, not in what they carry at "
      "rest. Each must be solved implicitly by the dynamics, as stiff as it is felt.";
  result.oracle = "At rest friction carries the weight, and the cube stays where it is.";
  result.scene = "grasp_in_air.xml";
  for (const Law& law : laws()) {
    for (const double mass : {0.002, 0.02, 0.2}) {
      for (const Method& method : {ours(), explicitCoupling()}) {
        Trial trial;
        trial.parameters = {{"friction law", law.name}, {"mass", number(mass * 1000) + " g"}};
        trial.method = method.name;
        if (!method.own()) trial.expected = Verdict::kUnstable;
        trial.run = [law, mass, method] { return hold(law, mass, method); };
        trial.quick = method.own() && mass < 0.01;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::grasp_by_law
