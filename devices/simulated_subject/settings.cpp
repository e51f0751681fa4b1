#include "devices/simulated_subject/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace presa {
namespace {

const DeviceBinding::Setting* settingOf(const DeviceBinding& binding, const std::string& key) {
  const auto found = binding.settings.find(key);
  return found == binding.settings.end() ? nullptr : &found->second;
}

/// The setting as a number >= `min`; `fallback` when it is not given.
template <class Number>
Number numberOf(const DeviceBinding& binding, const std::string& key, Number fallback, Number min,
                Diagnostics& diagnostics) {
  const DeviceBinding::Setting* setting = settingOf(binding, key);
  if (setting == nullptr) return fallback;
  Number value{};
  const char* end = setting->value.data() + setting->value.size();
  const auto [rest, status] = std::from_chars(setting->value.data(), end, value);
  if (status == std::errc{} && rest == end && std::isfinite(static_cast<double>(value)) && value >= min) return value;
  const std::string kind = std::is_integral_v<Number> ? "a non-negative whole number" : "a non-negative number";
  diagnostics.error(431, setting->where, key + " must be " + kind + ", found '" + setting->value + "'");
  return fallback;
}

std::int32_t bodyOf(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  const DeviceBinding::Setting* named = settingOf(binding, "object");
  std::vector<std::string> names;
  std::int32_t found = kNoBody;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const Body& body = world.scene.bodies[i];
    if (body.fixed || !body.haptic) continue;
    names.push_back(body.name);
    if (named == nullptr || named->value == body.name) found = static_cast<std::int32_t>(i);
  }
  if (found != kNoBody && (named != nullptr || names.size() == 1)) return found;
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  const std::string what =
      named != nullptr
          ? "there is no free body '" + named->value + "' that fingers can touch" + didYouMean(named->value, names)
          : "role '" + binding.role + "': which body should it grip? " + std::to_string(names.size()) + " candidates";
  diagnostics.error(432, named != nullptr ? named->where : binding.where, what,
                    names.empty() ? "give the scene a free body with a haptic geometry"
                                  : "add <set key=\"object\" value=\"NAME\"/>; free bodies: " + list);
  return kNoBody;
}

}  // namespace

SubjectSettings readSettings(const DeviceBinding& binding, const World& world, const RunOptions& options,
                             std::optional<double> resolution, Diagnostics& diagnostics) {
  SubjectSettings settings;
  if (const DeviceBinding::Setting* level = settingOf(binding, "level")) {
    const auto known = subject::levelNamed(level->value);
    if (!known) {
      diagnostics.error(433, level->where, "level must be L0, L1 or L2, found '" + level->value + "'",
                        "L0: limited by the device's steps; L1: also by human fingers; L2: L1 with position control");
    }
    settings.level = known.value_or(subject::Level::kL0);
  }
  settings.seed = numberOf<std::uint64_t>(binding, "seed", 1, 0, diagnostics);
  settings.subject = numberOf<std::uint64_t>(binding, "subject", 0, 0, diagnostics);
  if (const auto& person = options.person) {
    settings.seed = person->seed;
    settings.subject = person->subject;
    settings.level = subject::levelNamed(person->level).value_or(settings.level);
  }
  settings.trial = options.seed;
  // grip and load together must stay below the force limit, or the fingers would pass through the object
  for (const DeviceRole& role : world.scene.devices) {
    if (role.role != binding.role) continue;
    settings.max_grip = 0.9 * std::min(role.limits.force, binding.limits.force.value_or(role.limits.force));
  }
  settings.reach = numberOf(binding, "reach", settings.reach, 1e-3, diagnostics);
  settings.hold = numberOf(binding, "hold", settings.hold, 0.0, diagnostics);
  const double drawn = subject::drawResolution(settings.seed, settings.subject, settings.trial);
  settings.resolution = numberOf(binding, "resolution", resolution.value_or(drawn), 0.0, diagnostics);
  subject::Population population(settings.level);
  if (const DeviceBinding::Setting* noise = settingOf(binding, "noise")) {
    if (noise->value == "off") population.silence();
    if (noise->value != "off" && noise->value != "on")
      diagnostics.error(437, noise->where, "noise must be on or off, found '" + noise->value + "'");
  }
  if (const DeviceBinding::Setting* eyes = settingOf(binding, "eyes")) {
    settings.eyes_closed = eyes->value == "closed";
    if (eyes->value != "closed" && eyes->value != "open")
      diagnostics.error(439, eyes->where, "eyes must be open or closed, found '" + eyes->value + "'",
                        "closed: the subject does not see the object while holding it");
  }
  if (settingOf(binding, "loosening") != nullptr)
    population.set("loosening", subject::constant(numberOf(binding, "loosening", 0.4, 1e-3, diagnostics)));
  settings.parameters = population.draw(settings.seed, settings.subject);
  return settings;
}

Grasp readGrasp(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  Grasp grasp;
  grasp.body = bodyOf(binding, world, diagnostics);
  if (grasp.body == kNoBody) return grasp;
  const Body& body = world.scene.bodies[static_cast<std::size_t>(grasp.body)];
  grasp.p_WB = body.X_WB.p;
  grasp.inward_W = body.X_WB.q * Vec3::UnitX();
  grasp.inward_W.z() = 0;
  if (grasp.inward_W.norm() < 0.1) grasp.inward_W = Vec3::UnitX();
  grasp.inward_W.normalize();
  const Box* box = std::get_if<Box>(&body.haptic->shape);
  grasp.width = numberOf(binding, "width", box != nullptr ? box->size.x() : 0.0, 0.0, diagnostics);
  if (!(grasp.width > 0)) {
    diagnostics.error(434, binding.where,
                      "role '" + binding.role + "': how wide is '" + body.name + "' between the digits?",
                      "add <set key=\"width\" value=\"METRES\"/>; the width is known for a box only");
  }
  for (const DeviceRole& role : world.scene.devices) {
    for (const DeviceBinding& other : world.rig.devices) {
      if (other.role != role.role || other.driver != binding.driver) continue;
      Diagnostics unheard;
      grasp.radius[static_cast<std::size_t>(readDigit(other, unheard))] = role.fingertip_radius;
    }
  }
  return grasp;
}

int readDigit(const DeviceBinding& binding, Diagnostics& diagnostics) {
  const DeviceBinding::Setting* setting = settingOf(binding, "digit");
  const std::string& name = setting != nullptr ? setting->value : binding.role;
  if (name == "thumb") return 0;
  if (name == "index") return 1;
  diagnostics.error(435, setting != nullptr ? setting->where : binding.where,
                    "digit must be thumb or index, found '" + name + "'", "add <set key=\"digit\" value=\"thumb\"/>");
  return 0;
}

}  // namespace presa
