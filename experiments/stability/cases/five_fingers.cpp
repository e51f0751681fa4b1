#include <cmath>
#include <numbers>

#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"

namespace presa::stability::five_fingers {
namespace {

constexpr double kHalf = 0.035;                       // of the brick's width, as in the scene [m]
constexpr double kAmplitude = 0.015, kFrequency = 3;  // [m, Hz]

std::vector<Finding> shake(double mass, double stiffness, int axis, const Method& method) {
  Carried carried;
  carried.scene = "five_fingers.xml";
  carried.sets = std::vector<std::string>{"body/brick/physics/mass=" + number(mass),
                                          "material/skin/stiffness=" + number(stiffness)} +
                 method;
  carried.body = "brick";
  carried.stiffness = stiffness;
  Grip& grip = carried.grip;
  grip.points.emplace_back(-kHalf, 0, kHalf);
  grip.normals.emplace_back(-Vec3::UnitX());
  for (const double y : {0.03, 0.01, -0.01, -0.03}) {
    grip.points.emplace_back(kHalf, y, kHalf);
    grip.normals.emplace_back(Vec3::UnitX());
  }
  grip.move = [axis](std::size_t, double time) { return shaken(kAmplitude * Vec3::Unit(axis), kFrequency, time); };
  // the brick gives way until one spring balances four: k (d + u) = 4 k (d - u), u = 3/5 d
  const double force = stiffness * grip.depth;
  carried.forces = {1.6 * force, 0.4 * force, 0.4 * force, 0.4 * force, 0.4 * force};
  carried.oracle = "8/5 and 2/5 of k depth = " + number(force) + " N: one spring balances four";
  return carry(carried);
}

}  // namespace

Case make() {
  Case result;
  result.name = "five_fingers";
  result.title = "A thumb and four fingers hold a brick and shake it at 3 Hz, 15 mm to each side";
  result.source =
      "Statics of one spring against four, and equations of motion of a rigid body on five springs; nothing of the "
      "engine takes part.";
  result.oracle =
      "The thumb presses with 8/5 of k times its depth, a finger with 2/5; the brick follows these equations.";
  result.scene = "five_fingers.xml";
  result.trials = carriedTrials(shake);
  return result;
}

}  // namespace presa::stability::five_fingers
