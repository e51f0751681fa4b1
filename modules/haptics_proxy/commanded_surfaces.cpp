#include "modules/haptics_proxy/commanded_surfaces.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

constexpr double kThere = 1e-6;  // difference at which the target counts as reached, relative to the maximum [-]

}  // namespace

CommandedSurfaces::CommandedSurfaces(const Scene& scene) : materials_(scene.materials) {
  for (const OpenSurface& open : openSurfaces(scene)) {
    double& value = materials_[open.material].*open.value;
    ways_.push_back({&value, value, kThere * open.most});
  }
}

void CommandedSurfaces::step(const SurfaceSettings& settings, double period) noexcept {
  if (const std::size_t slot = taker_.next(settings); slot < ways_.size()) {
    ways_[slot].target = settings.slots[slot].value;
  }
  for (Way& way : ways_) {
    if (*way.value == way.target) continue;
    const double rest = way.target - *way.value;
    *way.value = std::abs(rest) <= way.near ? way.target : *way.value - rest * std::expm1(-period / kTimeConstant);
  }
}

}  // namespace presa
