#include <algorithm>
#include <cmath>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"
#include "experiments/stability/resting.h"

namespace presa::stability::gravity_five_and_zero {
namespace {

constexpr double kG = 9.81;
constexpr double kHeld = 5, kStands = 10;          // [s]
constexpr double kStiffness = 2000, kMass = 0.05;  // of skin and cube [N/m, kg]
constexpr double kLift = 0.03, kStart = 0.035;     // of the cube [m]
constexpr int kBlocks = 20;                        // as in the scene, as is their mass
constexpr double kBlockMass = 0.05;

std::string gravity(double times) { return "world/gravity=0 0 " + number(-times * kG); }

std::vector<Finding> hold(double times, const Method& method) {
  Pinch pinch;
  pinch.center = {0.0001, 0, 0.035};
  pinch.width = 0.07;
  pinch.depth = std::max(0.002, 1.5 * kMass * times * kG / (2 * kStiffness));
  pinch.lift = kLift;
  const std::vector<std::string> sets{gravity(times), "body/cube/physics/mass=" + number(kMass)};
  StudyRun run(specOf("grasp_in_air.xml", sets + method, kHeld), pinchFingers(pinch));
  const std::size_t cube = bodyNamed(run.world(), "cube");
  const double wanted = kStiffness * pinch.depth, sag = kMass * times * kG / (2 * kStiffness);
  double force = 0, height = 0;
  Curve shown{"height of the cube", {}, {}};
  run.observe([&](const HapticSample& sample) {
    const double z = sample.objects->bodies[cube].X_WB_end.p.z();
    shown.x.push_back(sample.tick.time);
    shown.y.push_back(1000 * z);
    if (sample.tick.time < kHeld - 1) return;
    height = std::max(height, std::abs(z - (kStart + kLift - sag)));
    for (std::size_t f = 0; f < 2; ++f) {
      force = std::max(force, std::abs(sample.contact.fingers[f].normal_force / wanted - 1));
    }
  });
  run.run();

  Finding off = finding("height beside that of the springs", 1e6 * height, "um", 1,
                        "the cube hangs m g / (2 k) = " + number(1e6 * sag) + " um below where the fingers carry it");
  off.plot_x = "time [s]";
  off.plot_y = "height of the cube [mm]";
  off.curves = {decimated(std::move(shown))};
  return {off, finding("grip force error", 100 * force, "%", 0.1, "k depth = " + number(wanted) + " N from each")};
}

/// Each cube yields at its four corners by what it carries; with no weight it stays where it was put.
std::vector<Finding> stand(double times, const Method& method) {
  const double load = kBlockMass * times * kG * kBlocks * (kBlocks + 1) / 2;  // summed over the joints [N]
  Pile tower(specOf("falling_tower.xml", std::vector<std::string>{gravity(times), "dynamics/sleeping=false"} + method,
                    kStands),
             "b" + std::to_string(kBlocks - 1));
  tower.run();
  return {tower.displacement(0.001 + 10 * yieldBound(load / 4, 1)), tower.restSpeed()};
}

}  // namespace

Case make() {
  Case result;
  result.name = "gravity_five_and_zero";
  result.title = "A grasp and a tower without gravity, on earth and at five times its gravity";
  result.source =
      "Weight is the load of every contact: at 5 g the bounds of stability are five times nearer, without it nothing "
      "holds a body in place but the contacts that push.";
  result.oracle = "A held cube hangs m g / (2 k) below the fingers, for any g; a tower of 20 stands, for any g.";
  result.scene = "grasp_in_air.xml";
  for (const bool tower : {false, true}) {
    for (const double times : {0.0, 1.0, 5.0}) {
      for (const Method& method : {ours(), tower ? twentyIterations() : explicitCoupling()}) {
        Trial trial;
        trial.parameters = {{"what", tower ? "tower of 20 cubes" : "grasp"}, {"gravity", number(times) + " g"}};
        trial.method = method.name;
        if (!method.own() && !(tower && times == 0)) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return tower ? stand(times, method) : hold(times, method); };
        trial.quick = method.own();
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::gravity_five_and_zero
