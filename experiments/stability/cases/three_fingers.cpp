#include <cmath>
#include <numbers>

#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"

namespace presa::stability::three_fingers {
namespace {

constexpr double kRadius = 0.035;                     // of the can, as in the scene [m]
constexpr double kHeight = 0.035;                     // of its middle above the table [m]
constexpr double kAmplitude = 0.015, kFrequency = 3;  // [m, Hz]

std::vector<Finding> shake(double mass, double stiffness, int axis, const Method& method) {
  Carried carried;
  carried.scene = "three_fingers.xml";
  carried.sets = std::vector<std::string>{"body/can/physics/mass=" + number(mass),
                                          "material/skin/stiffness=" + number(stiffness)} +
                 method;
  carried.body = "can";
  carried.stiffness = stiffness;
  Grip& grip = carried.grip;
  for (const double angle : {1.0, 1.0 / 3, -1.0 / 3}) {
    grip.normals.emplace_back(std::cos(angle * std::numbers::pi), std::sin(angle * std::numbers::pi), 0);
    grip.points.emplace_back(kRadius * grip.normals.back() + kHeight * Vec3::UnitZ());
  }
  grip.move = [axis](std::size_t, double time) { return shaken(kAmplitude * Vec3::Unit(axis), kFrequency, time); };
  carried.forces.assign(3, stiffness * grip.depth);
  carried.oracle = "k depth = " + number(carried.forces[0]) + " N from each finger";
  return carry(carried);
}

}  // namespace

Case make() {
  Case result;
  result.name = "three_fingers";
  result.title = "Three fingers hold a can and shake it at 3 Hz, 15 mm to each side";
  result.source =
      "Statics of three equal springs 120 degrees apart, and equations of motion of a rigid body on them; nothing of "
      "the engine takes part.";
  result.oracle = "Each finger presses with k times its depth; the can follows these equations, integrated at 10 us.";
  result.scene = "three_fingers.xml";
  result.trials = carriedTrials(shake);
  return result;
}

}  // namespace presa::stability::three_fingers
