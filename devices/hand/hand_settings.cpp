#include "devices/hand/hand_settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "devices/hand/finger_plant.h"
#include "framework/core/schedule/rates.h"
#include "framework/input/folders.h"

namespace presa {
namespace {

std::unique_ptr<Motion> readMotion(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  const auto file = binding.settings.find("motion");
  if (file == binding.settings.end()) {
    diagnostics.error(402, binding.where,
                      "role '" + binding.role + "': driver '" + binding.driver + "' needs the setting 'motion'",
                      "add <set key=\"motion\" value=\"FILE.xml\"/> (phases) or FILE.csv (keyframes)");
    return nullptr;
  }
  if (!input::checkNamed(file->second.where, file->second.value, diagnostics)) return nullptr;
  MotionContext context{binding.role, sideOf(binding, diagnostics), 0};
  for (const DeviceRole& role : world.scene.devices) {
    if (role.role == binding.role) context.fingertip_radius = role.fingertip_radius;
  }
  const bool keyframes = file->second.value.ends_with(".csv");
  return keyframes ? readKeyframeMotion(file->second.value, context, diagnostics)
                   : readPhasedMotion(file->second.value, context, diagnostics);
}

/// Chooses the damping when none is given; returns a note for the user.
std::string settleDamping(const std::string& role, const World& world, double carried, FingerImpedance& impedance) {
  double stiffest = 0;
  for (const Body& body : world.scene.bodies) {
    if (body.haptic) stiffest = std::max(stiffest, world.scene.materialOf(body).stiffness);
  }
  const RateTable rates(world.scene.rates);
  const double period = rates.period(RateGroup::kHaptic), dynamics_period = rates.period(RateGroup::kDynamics);
  const bool automatic = !(impedance.damping > 0);
  FingerImpedance moved = impedance;
  moved.mass += carried;
  if (automatic) impedance.damping = automaticDamping(moved, stiffest, period, dynamics_period);
  const double bound =
      std::max(wallDampingBound(stiffest, period), heldObjectDampingBound(moved, stiffest, period, dynamics_period));
  std::array<char, 240> text;
  std::snprintf(text.data(), text.size(),
                "%s: finger damping %.3g N s/m%s; contacts of %.3g N/mm at %.0f and %.0f Hz need %.3g", role.c_str(),
                impedance.damping, automatic ? " (auto)" : "", stiffest * 1e-3, 1 / period, 1 / dynamics_period, bound);
  return text.data() + std::string(impedance.damping < bound ? ": UNSTABLE, raise damping or lower stiffness" : "");
}

}  // namespace

std::vector<double> settingNumbers(const DeviceBinding& binding, const std::string& key) {
  std::vector<double> numbers;
  const auto found = binding.settings.find(key);
  if (found == binding.settings.end()) return numbers;
  std::istringstream text(found->second.value);
  for (double value; text >> value;) numbers.push_back(value);
  return numbers;
}

double fingertipOf(const DeviceBinding& binding, const World& world) {
  for (const DeviceRole& role : world.scene.devices) {
    if (role.role == binding.role) return role.fingertip_radius;
  }
  return 0;
}

double sideOf(const DeviceBinding& binding, Diagnostics& diagnostics) {
  if (const auto side = binding.settings.find("side"); side != binding.settings.end()) {
    if (side->second.value == "-1") return -1;
    if (side->second.value == "1" || side->second.value == "+1") return 1;
    diagnostics.error(404, side->second.where, "side must be -1 or 1, found '" + side->second.value + "'",
                      "-1: negative end of the grasp axis (thumb); 1: positive end (index)");
  }
  return binding.role == "thumb" ? -1 : 1;
}

HandSettings readImpedance(const DeviceBinding& binding, const World& world, double carried, FingerImpedance impedance,
                           Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  HandSettings hand;
  hand.impedance.mass = positiveSetting(binding, "mass", impedance.mass, diagnostics);
  hand.impedance.stiffness = positiveSetting(binding, "stiffness", impedance.stiffness, diagnostics);
  hand.impedance.damping = positiveSetting(binding, "damping", impedance.damping, diagnostics);
  if (diagnostics.errorCount() == before)
    hand.notes.push_back(settleDamping(binding.role, world, carried, hand.impedance));
  return hand;
}

HandSettings readHand(const DeviceBinding& binding, const World& world, double carried, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  std::unique_ptr<Motion> motion = readMotion(binding, world, diagnostics);
  HandSettings hand =
      readImpedance(binding, world, carried, motion ? motion->impedance() : FingerImpedance{}, diagnostics);
  hand.lost_at = positiveSetting(binding, "lost_at", std::numeric_limits<double>::infinity(), diagnostics);
  if (diagnostics.errorCount() == before) hand.motion = std::move(motion);
  return hand;
}

}  // namespace presa
