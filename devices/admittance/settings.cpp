#include "devices/admittance/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "framework/core/schedule/rates.h"

namespace presa::admittance {
namespace {

enum Code : int { kBadNumber = 450, kBadPlace = 451, kShakesByItself = 452, kOutOfReach = 453 };

void readNumber(const DeviceBinding& binding, const std::string& key, bool may_be_zero, double& value,
                Diagnostics& diagnostics) {
  const auto found = binding.settings.find(key);
  if (found == binding.settings.end()) return;
  const std::string& text = found->second.value;
  double read = 0;
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), read);
  const bool good = status == std::errc{} && rest == text.data() + text.size() && std::isfinite(read) &&
                    (may_be_zero ? read >= 0 : read > 0);
  if (good)
    value = read;
  else
    diagnostics.error(
        kBadNumber, found->second.where,
        key + " must be a number" + (may_be_zero ? ", not negative" : " above 0") + ", found " + quote(text));
}

void readPlace(const DeviceBinding& binding, const std::string& key, bool positive, Vec3& value,
               Diagnostics& diagnostics) {
  const auto found = binding.settings.find(key);
  if (found == binding.settings.end()) return;
  std::istringstream text(found->second.value);
  Vec3 read = Vec3::Zero();
  std::string more;
  const bool three = static_cast<bool>(text >> read.x() >> read.y() >> read.z()) && !(text >> more);
  if (three && read.allFinite() && (!positive || read.minCoeff() > 0))
    value = read;
  else
    diagnostics.error(
        kBadPlace, found->second.where,
        key + " must be three numbers" + (positive ? " above 0" : "") + " [m], found " + quote(found->second.value));
}

/// Reports a motion that leaves the box between the end stops.
void checkReach(const DeviceBinding& binding, const Motion& motion, const Parameters& p, Diagnostics& diagnostics) {
  constexpr double kStep = 0.01;  // [s]
  const double end = motion.phase_times.empty() ? 0 : motion.phase_times.back();
  for (int i = 0; i * kStep <= end; ++i) {
    const Vec3 at = motion.at(i * kStep).p_WT;
    if (((at - p.centre).cwiseAbs() - p.half_travel).maxCoeff() <= 0) continue;
    std::array<char, 200> text;
    std::snprintf(text.data(), text.size(),
                  "role '%s': at %.2f s the motion leaves the device's travel: %.3f %.3f %.3f m", binding.role.c_str(),
                  i * kStep, at.x(), at.y(), at.z());
    diagnostics.error(kOutOfReach, binding.where, text.data(), "shift the box (centre) or enlarge it (half_travel)");
    return;
  }
}

std::string noteOn(const std::string& role, const Parameters& p, double stiffest) {
  std::array<char, 240> text;
  std::snprintf(
      text.data(), text.size(),
      "%s: admittance device of %.3g kg and %.3g N s/m behind a servo of %.3g Hz: walls are stable up to %.3g N/mm",
      role.c_str(), p.inertia, p.viscosity, p.bandwidth, stiffest * 1e-3);
  return text.data();
}

}  // namespace

Settings readSettings(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  Settings settings;
  Parameters& p = settings.parameters;
  readNumber(binding, "inertia", false, p.inertia, diagnostics);
  readNumber(binding, "viscosity", true, p.viscosity, diagnostics);
  readNumber(binding, "bandwidth", false, p.bandwidth, diagnostics);
  readNumber(binding, "noise", true, p.noise, diagnostics);
  readNumber(binding, "most_force", false, p.max_force, diagnostics);
  readNumber(binding, "most_speed", false, p.max_speed, diagnostics);
  readPlace(binding, "centre", false, p.centre, diagnostics);
  readPlace(binding, "half_travel", true, p.half_travel, diagnostics);
  double seed = 1;
  readNumber(binding, "seed", true, seed, diagnostics);
  settings.seed = static_cast<std::uint64_t>(seed);
  settings.hand = readHand(binding, world, p.inertia, diagnostics);
  if (settings.hand.motion) {
    checkReach(binding, *settings.hand.motion, p, diagnostics);
    settings.stiffest_wall =
        stiffestWall(p, settings.hand.impedance, RateTable(world.scene.rates).period(RateGroup::kHaptic));
    if (!(settings.stiffest_wall > 0))
      diagnostics.error(kShakesByItself, binding.where,
                        "role '" + binding.role + "': this device is unstable with the hand alone",
                        "raise inertia, viscosity or bandwidth, or lower the hand's stiffness");
    settings.hand.notes.push_back(noteOn(binding.role, p, settings.stiffest_wall));
  }
  if (diagnostics.errorCount() > before) settings.hand.motion = nullptr;
  return settings;
}

}  // namespace presa::admittance
