#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"
#include "experiments/stability/methods.h"

namespace presa::stability::two_hands {
namespace {

// as in the scene: half the width of the bar, half the distance of the hands, height of the bar's middle [m]
constexpr double kHalf = 0.02, kReach = 0.15, kHeight = 0.02;
constexpr double kAmplitude = 0.015, kFrequency = 3;  // [m, Hz]

enum class Motion { kShaken, kTilted, kTurned };

/// The hands move alike, or one up (or to and fro) while the other goes the other way.
PrescribedFinger::State moved(Motion motion, std::size_t finger, double time) {
  const double side = finger < 2 ? -1 : 1;
  switch (motion) {
    case Motion::kShaken:
      return shaken(kAmplitude * Vec3::UnitX(), kFrequency, time);
    case Motion::kTilted:
      return shaken(side * kAmplitude * Vec3::UnitZ(), kFrequency, time);
    case Motion::kTurned:
      // a third: the fingertips do not turn with the bar, and 0.1 rad would make them slip
      return shaken(side * kAmplitude / 3 * Vec3::UnitY(), kFrequency, time);
  }
  return {};
}

std::vector<Finding> hold(Motion motion, double mass, double stiffness, const Method& method) {
  Carried carried;
  carried.scene = "two_hands.xml";
  carried.sets = std::vector<std::string>{"body/bar/physics/mass=" + number(mass),
                                          "material/skin/stiffness=" + number(stiffness)} +
                 method;
  carried.body = "bar";
  carried.stiffness = stiffness;
  Grip& grip = carried.grip = twoHands(kReach, kHalf, kHeight);
  grip.move = [motion](std::size_t finger, double time) { return moved(motion, finger, time); };
  carried.forces.assign(4, stiffness * grip.depth);
  carried.oracle = "k depth = " + number(carried.forces[0]) + " N from each finger";
  return carry(carried);
}

}  // namespace

Case make() {
  Case result;
  result.name = "two_hands";
  result.title = "Two hands hold a bar of 400 mm at its ends, shake, tilt and turn it at 3 Hz";
  result.source =
      "Equations of motion of a rigid body on four springs whose far ends move as prescribed; two stiff grasps on "
      "one body constrain it more than it has freedoms.";
  result.oracle = "Each finger presses with k times its depth; the bar follows these equations, integrated at 10 us.";
  result.scene = "two_hands.xml";
  const std::vector<std::pair<Motion, std::string>> motions{
      {Motion::kShaken, "shaken"}, {Motion::kTilted, "tilted"}, {Motion::kTurned, "turned"}};
  for (const double stiffness : {2000.0, 10'000.0}) {
    for (const double mass : {0.02, 0.2}) {
      for (const auto& [motion, name] : motions) {
        for (const Method& method : {ours(), explicitCoupling()}) {
          Trial trial;
          trial.parameters = {
              {"stiffness", number(stiffness / 1000) + " N/mm"}, {"mass", number(mass * 1000) + " g"}, {"bar", name}};
          trial.method = method.name;
          // light bars explode below the bound of symplectic Euler
          if (!method.own() && (mass < 0.1 || stiffness > 5000)) trial.expected = Verdict::kUnstable;
          trial.run = [=, motion = motion] { return hold(motion, mass, stiffness, method); };
          trial.quick = stiffness > 5000 && mass < 0.05;
          result.trials.push_back(std::move(trial));
        }
      }
    }
  }
  return result;
}

}  // namespace presa::stability::two_hands
