#include "framework/session/stiffness_bound.h"

#include <array>
#include <cstdio>

#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"
#include "framework/session/session.h"

namespace presa {
namespace {

/// Relative tolerance: above the rounding of a damping chosen to lie at the bound, too small to be felt.
constexpr double kRounding = 1e-6;

bool touchable(const Scene& scene, std::size_t material) {
  for (const Body& body : scene.bodies) {
    if (body.haptic && body.material == material) return true;
  }
  return false;
}

std::string inWords(const Material& material, double allowed, const StiffnessBound& bound) {
  std::array<char, 320> text;
  std::snprintf(
      text.data(), text.size(),
      "material '%s' of %.4g N/mm is felt with %.4g N/mm: half of K_max = b / ((d + 1/2) T) = %.4g N/mm, with the "
      "b = %.3g N s/m of '%s', d = %d and T = %.3g ms",
      material.name.c_str(), material.stiffness * 1e-3, allowed * 1e-3, bound.stiffness * 1e-3, bound.damping,
      bound.role.c_str(), bound.delay, bound.period * 1e3);
  return text.data();
}

}  // namespace

StiffnessBound stiffnessBound(const DeviceList& devices, const Plan& plan, const Scene& scene) {
  StiffnessBound min;
  const double period = RateTable(scene.rates).period(RateGroup::kHaptic);
  for (std::size_t f = 0; f < devices.size(); ++f) {
    const double damping = devices[f]->damping();
    if (!(damping > 0)) continue;
    const int delay = devicePlugin(plan.devices[f].driver).hardware ? 1 : 0;
    const double stiffness = damping / ((delay + 0.5) * period);
    if (min.stiffness > 0 && min.stiffness <= stiffness) continue;
    min = {stiffness, damping, delay, period, plan.devices[f].role};
  }
  return min;
}

std::vector<Override> boundedMaterials(const Scene& scene, const StiffnessBound& bound, Diagnostics& diagnostics) {
  std::vector<Override> lowered;
  if (!(bound.stiffness > 0)) return lowered;
  const double allowed = kStableShare * bound.stiffness;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (material.stiffness <= allowed * (1 + kRounding) || !touchable(scene, m)) continue;
    diagnostics.warning(454, material.where, inWords(material, allowed, bound),
                        "more damping of hand or device, or a higher haptic rate, allows more");
    std::array<char, 32> value;
    std::snprintf(value.data(), value.size(), "%.17g", allowed);
    lowered.push_back({"material/" + material.name + "/stiffness", value.data()});
  }
  return lowered;
}

}  // namespace presa
