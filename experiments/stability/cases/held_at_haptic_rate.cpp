#include <cmath>
#include <numbers>

#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"
#include "experiments/stability/methods.h"

namespace presa::stability::held_at_haptic_rate {
namespace {

// as in the scene: half the width of the bar, half the distance of the hands, height of the bar's middle [m]
constexpr double kHalf = 0.02, kReach = 0.15, kHeight = 0.02;
constexpr double kStiffness = 2000;  // [N/m]

std::vector<Finding> hold(double frequency, double mass, const Method& method) {
  Carried carried;
  carried.scene = "two_hands.xml";
  carried.sets = std::vector<std::string>{"body/bar/physics/mass=" + number(mass),
                                          "material/skin/stiffness=" + number(kStiffness)} +
                 method;
  carried.body = "bar";
  carried.stiffness = kStiffness;
  Grip& grip = carried.grip = twoHands(kReach, kHalf, kHeight);
  // 3 m/s^2 at any frequency
  const double amplitude = 3 / std::pow(2 * std::numbers::pi * frequency, 2);
  grip.move = [=](std::size_t, double time) { return shaken(amplitude * Vec3::UnitX(), frequency, time); };
  carried.forces.assign(4, kStiffness * grip.depth);
  carried.oracle = "k depth = " + number(carried.forces[0]) + " N from each finger";
  carried.bound = 0.006;
  return carry(carried);
}

}  // namespace

Case make() {
  Case result;
  result.name = "held_at_haptic_rate";
  result.title = "A bar in two hands, shaken at 3 to 12 Hz, moved by the haptic thread instead of the dynamics";
  result.source =
      "Harwin and Barrow, section 6.2: objects of low inertia are stable in the fingers when their position is updated "
      "at haptic rates.";
  result.oracle = "The bar follows the equations of motion of a body on four springs, integrated at 10 us, to 6 um.";
  result.scene = "two_hands.xml";
  for (const double mass : {0.005, 0.2}) {
    for (const double frequency : {3.0, 12.0}) {
      for (const Method& method : {hapticRate(), dynamicsRate()}) {
        Trial trial;
        trial.parameters = {{"mass", number(mass * 1000) + " g"}, {"shaken at", number(frequency) + " Hz"}};
        trial.method = method.name;
        if (!method.own()) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return hold(frequency, mass, method); };
        trial.quick = mass < 0.01 && frequency > 10;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::held_at_haptic_rate
