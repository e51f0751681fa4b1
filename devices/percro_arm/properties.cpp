#include "devices/percro_arm/properties.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace presa::percro {
namespace {

constexpr double kRigid = 1e3;     // times the stiffness of the structure: 4 N bend it by less than 3 um
constexpr double kLight = 1e-2;    // times the mass and inertia of every part
constexpr double kFastLoop = 1e6;  // [Hz]
constexpr double kStrong = 1e3;    // times the torque of the motors

void stiffen(Parameters& arm) {
  arm.structure.axial_stiffness *= kRigid;
  arm.structure.bend_linear /= kRigid;
  arm.structure.bend_cubic /= kRigid;
  arm.structure.damping_time /= kRigid;  // the same damping
}

void lighten(Parameters& arm) {
  for (double* mass : {&arm.masses.barrel, &arm.masses.barrel_inertia, &arm.masses.roll_inertia,
                       &arm.masses.counterweight, &arm.masses.tilt_inertia, &arm.masses.yaw_inertia})
    *mass *= kLight;
  arm.motors.rotor_inertia *= kLight;
}

constexpr std::array kProperties{
    Property{"compliance", "the structure bends between encoders and fingertip", stiffen},
    Property{"encoders", "motors are counted in whole steps", [](Parameters& arm) { arm.motors.counted = false; }},
    Property{"friction", "bearings and transmission rub",
             [](Parameters& arm) {
               arm.friction = {{}, {}};
             }},
    Property{"inertia", "links and rotors have mass", lighten},
    Property{"bandwidth", "the current loop lags", [](Parameters& arm) { arm.motors.current_bandwidth = kFastLoop; }},
    Property{"heat", "motors have a peak torque, and less when they are warm", [](Parameters& arm) {
               arm.motors.continuous_torque *= kStrong;
               arm.motors.peak_torque *= kStrong;
             }}};

}  // namespace

std::span<const Property> properties() { return kProperties; }

std::vector<std::string> removeProperties(const std::string& words, Parameters& arm) {
  std::vector<std::string> unknown;
  std::istringstream text(words);
  for (std::string word; text >> word;) {
    const auto found = std::ranges::find(kProperties, word, &Property::name);
    if (found == kProperties.end())
      unknown.push_back(word);
    else
      found->remove(arm);
  }
  return unknown;
}

}  // namespace presa::percro
