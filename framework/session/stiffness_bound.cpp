#include "framework/session/stiffness_bound.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"
#include "framework/haptics/friction_laws.h"
#include "framework/scene/manifest.h"
#include "framework/session/session.h"

namespace presa {
namespace {

enum StiffnessBoundCode { kStiffnessBound = 454, kDampingBound = 464 };

/// Relative tolerance: above the rounding of a damping chosen to lie at the bound, too small to be felt.
constexpr double kAllowedRounding = 1e-6;

bool touchable(const Scene& scene, std::size_t material) {
  for (const Body& body : scene.bodies) {
    if (body.haptic && body.material == material) return true;
  }
  return false;
}

/// How stiffnesses are written.
struct Units {
  const char *stiffness, *damping;
  double scale;  // of the number that is shown
};
constexpr Units kOfForce{"N/mm", "N s/m", 1e-3}, kOfTorque{"N m/rad", "N m s/rad", 1};

std::string inWords(const std::string& what, double stiffness, double allowed, const StiffnessBound& bound,
                    const Units& units) {
  std::array<char, 320> text;
  std::snprintf(text.data(), text.size(),
                "%s of %.4g %s is felt with %.4g %s: half of K_max = b / ((d + 1/2) T) = %.4g %s, with the "
                "b = %.3g %s of '%s', d = %d and T = %.3g ms",
                what.c_str(), stiffness * units.scale, units.stiffness, allowed * units.scale, units.stiffness,
                bound.stiffness * units.scale, units.stiffness, bound.damping, units.damping, bound.role.c_str(),
                bound.delay, bound.period * 1e3);
  return text.data();
}

std::string inWords(const Material& material, double allowed, const DampingBound& bound) {
  std::array<char, 320> text;
  std::snprintf(text.data(), text.size(),
                "damping of material '%s' of %.4g N s/m is felt with %.4g N s/m: half of B_max = "
                "2 m cos(d pi / (2 d + 1)) / T = %.4g N s/m, with the m = %.3g kg of '%s', d = %d and T = %.3g ms",
                material.name.c_str(), material.damping, allowed, bound.damping, bound.mass, bound.role.c_str(),
                bound.delay, bound.period * 1e3);
  return text.data();
}

std::string exactly(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

/// Samples until a force acts: a model's acts at once, a command to hardware one cycle later.
int delayOf(const Plan& plan, std::size_t device) { return devicePlugin(plan.devices[device].driver).hardware ? 1 : 0; }

/// The stiffnesses of a friction law: the attributes of its element in N/m.
std::vector<std::string> stiffnessesOf(const PluginElement& element) {
  std::vector<std::string> names;
  const Manifest::Element* known = findElement(element.element);
  if (known == nullptr) return names;
  for (const Manifest::Attribute& attribute : known->attributes) {
    if (attribute.unit == "N/m") names.push_back(attribute.name);
  }
  return names;
}

/// A spring of k in the scene is one of s^2 k in a hand whose frame has the scale s, and a mass or damping of the hand is
/// one of 1 / s^2 in the scene.
double seenThroughZoom(const Plan& plan, std::size_t f, double value) {
  const double zoom = plan.devices[f].zoom;
  return value / (zoom * zoom);
}

/// Of the devices that `is_meant` names. `damping_of`: of a device, 0: unknown.
template <class IsMeant, class DampingOf>
StiffnessBound smallestBound(const DeviceList& devices, const Plan& plan, const Scene& scene, const IsMeant& is_meant,
                             const DampingOf& damping_of) {
  StiffnessBound min;
  const double period = RateTable(scene.rates).period(RateGroup::kHaptic);
  for (std::size_t f = 0; f < devices.size(); ++f) {
    const double damping = is_meant(f) ? damping_of(f) : 0;
    if (!(damping > 0)) continue;
    const int delay = delayOf(plan, f);
    const double stiffness = damping / ((delay + 0.5) * period);
    if (min.stiffness > 0 && min.stiffness <= stiffness) continue;
    min = {stiffness, damping, delay, period, plan.devices[f].role};
  }
  return min;
}

/// Lowers stiffnesses to the share of a bound that is stable.
class Lowering {
 public:
  Lowering(const StiffnessBound& bound, const Units& units, Diagnostics& diagnostics)
      : bound_(bound), units_(units), diagnostics_(diagnostics) {}

  void lower(const std::string& what, double stiffness, const SourceLocation& where, std::string path,
             std::vector<Override>& lowered) const {
    const double allowed = kStableShare * bound_.stiffness;
    if (!(allowed > 0) || stiffness <= allowed * (1 + kAllowedRounding)) return;
    diagnostics_.warning(kStiffnessBound, where, inWords(what, stiffness, allowed, bound_, units_),
                         "more damping of hand or device, or a higher haptic rate, allows more");
    lowered.push_back({std::move(path), exactly(allowed)});
  }

 private:
  const StiffnessBound& bound_;
  const Units& units_;
  Diagnostics& diagnostics_;
};

}  // namespace

StiffnessBound stiffnessBound(const DeviceList& devices, const Plan& plan, const Scene& scene) {
  return smallestBound(
      devices, plan, scene, [&](std::size_t f) { return !scene.hasFingertips() || !scene.devices[f].tool; },
      [&](std::size_t f) { return seenThroughZoom(plan, f, devices[f]->damping()); });
}

// A zoom scales lengths, not angles.
std::vector<Override> boundedHandles(const DeviceList& devices, const Plan& plan, const Scene& scene,
                                     Diagnostics& diagnostics) {
  std::vector<Override> lowered;
  for (std::size_t d = 0; d < scene.devices.size(); ++d) {
    const DeviceRole& role = scene.devices[d];
    if (!role.tool) continue;
    const auto own = [&](std::size_t f) { return f == d; };
    const StiffnessBound of_force = smallestBound(
        devices, plan, scene, own, [&](std::size_t f) { return seenThroughZoom(plan, f, devices[f]->damping()); });
    const StiffnessBound of_torque =
        smallestBound(devices, plan, scene, own, [&](std::size_t f) { return devices[f]->turnDamping(); });
    const std::string name = "the handle of tool '" + role.role + "'", path = "device/" + role.role + "/tool/";
    Lowering(of_force, kOfForce, diagnostics)
        .lower(name, role.tool->coupling.stiffness, role.where, path + "stiffness", lowered);
    Lowering(of_torque, kOfTorque, diagnostics)
        .lower("turning " + name, role.tool->coupling.turn_stiffness, role.where, path + "turn_stiffness", lowered);
  }
  return lowered;
}

std::vector<Override> boundedMaterials(const Scene& scene, const StiffnessBound& bound, Diagnostics& diagnostics) {
  std::vector<Override> lowered;
  const Lowering lowering(bound, kOfForce, diagnostics);
  if (!scene.hasFingertips()) return lowered;  // a tool feels the spring of its handle, whatever it touches
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (!touchable(scene, m)) continue;
    const std::string name = "material '" + material.name + "'", path = "material/" + material.name;
    lowering.lower(name, material.stiffness, material.where, path + "/stiffness", lowered);
    const PluginElement* law = frictionElementOf(scene, m);
    if (law == nullptr) continue;
    for (const std::string& attribute : stiffnessesOf(*law)) {
      lowering.lower("<" + law->element + " " + attribute + "> of " + name, law->number(attribute), law->where,
                     path + "/friction/" + law->element + "/" + attribute, lowered);
    }
  }
  return lowered;
}

DampingBound dampingBound(const DeviceList& devices, const Plan& plan, const Scene& scene) {
  DampingBound min;
  const double period = RateTable(scene.rates).period(RateGroup::kHaptic);
  for (std::size_t f = 0; f < devices.size(); ++f) {
    const double mass = seenThroughZoom(plan, f, devices[f]->mass());
    if (!(mass > 0)) continue;
    const int delay = delayOf(plan, f);
    const double damping = 2 * mass * std::cos(delay * std::numbers::pi / (2 * delay + 1)) / period;
    if (min.damping > 0 && min.damping <= damping) continue;
    min = {damping, mass, delay, period, plan.devices[f].role};
  }
  return min;
}

std::vector<Override> boundedDampings(const Scene& scene, const DampingBound& bound, Diagnostics& diagnostics) {
  std::vector<Override> lowered;
  if (!(bound.damping > 0)) return lowered;
  const double allowed = kStableShare * bound.damping;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (!touchable(scene, m) || material.damping <= allowed * (1 + kAllowedRounding)) continue;
    diagnostics.warning(kDampingBound, material.where, inWords(material, allowed, bound),
                        "a heavier hand or device, or a higher haptic rate, allows more");
    lowered.push_back({"material/" + material.name + "/damping", exactly(allowed)});
  }
  return lowered;
}

}  // namespace presa
