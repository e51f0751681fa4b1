#include "modules/haptics_proxy/commanded_surfaces.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

constexpr double kArrived = 1e-6;  // difference at which the target counts as reached, relative to the maximum [-]

}  // namespace

CommandedSurfaces::CommandedSurfaces(const Scene& scene) : materials_(scene.materials) {
  for (const OpenSurface& open : openSurfaces(scene)) {
    double& value = materials_[open.material].*open.value;
    transitions_.push_back({&value, value, kArrived * open.max});
  }
}

void CommandedSurfaces::step(const SurfaceSettings& settings, double period) noexcept {
  if (const std::size_t slot = taker_.next(settings); slot < transitions_.size()) {
    transitions_[slot].target = settings.slots[slot].value;
  }
  for (Transition& transition : transitions_) {
    if (*transition.value == transition.target) continue;
    const double rest = transition.target - *transition.value;
    *transition.value = std::abs(rest) <= transition.near
                            ? transition.target
                            : *transition.value - rest * std::expm1(-period / kTimeConstant);
  }
}

}  // namespace presa
