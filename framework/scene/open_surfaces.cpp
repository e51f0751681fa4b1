#include "framework/scene/open_surfaces.h"

#include <algorithm>

#include "framework/scene/surface_settings.h"

namespace presa {
namespace {

constexpr double kMinStiffness = 1;  // [N/m]; the surface must not vanish
constexpr double kMaxFriction = 2;   // multiple of the loaded coefficient [-]

}  // namespace

std::vector<OpenSurface> openSurfaces(const Scene& scene) {
  std::vector<OpenSurface> open;
  const bool friction = scene.haptics.proxy && !scene.surfacesChange();
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    const bool touched = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                     [&](const Body& body) { return body.haptic && body.material == m; });
    if (!touched || scene.devices.empty()) continue;
    const std::string path = "material/" + material.name + "/";
    open.push_back(
        {m, &Material::stiffness, path + "stiffness", std::min(kMinStiffness, material.stiffness), material.stiffness});
    if (!friction || !(material.friction_static > 0)) continue;
    open.push_back(
        {m, &Material::friction_static, path + "friction/static", 0, kMaxFriction * material.friction_static});
    if (!(material.friction_dynamic > 0)) continue;
    open.push_back(
        {m, &Material::friction_dynamic, path + "friction/dynamic", 0, kMaxFriction * material.friction_dynamic});
  }
  if (open.size() > SurfaceSettings::kCapacity) open.resize(SurfaceSettings::kCapacity);
  return open;
}

}  // namespace presa
