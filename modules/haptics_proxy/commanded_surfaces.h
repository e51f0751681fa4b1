#pragma once
#include <vector>

#include "framework/scene/open_surfaces.h"
#include "framework/scene/surface_settings.h"

namespace presa {

/// The materials in force when commands may change them. Each parameter approaches its commanded value with a time
/// constant, so that a pressing finger feels no step: a force F changes by less than F period / kTimeConstant per tick,
/// 0.7 % at 1 kHz.
/// Thread: haptic; nonblocking except for construction.
class CommandedSurfaces {
 public:
  static constexpr double kTimeConstant = 0.15;  ///< [s]

  explicit CommandedSurfaces(const Scene& scene);
  /// Same order as Scene::materials. Only open parameters differ from the scene, and only after a command.
  const std::vector<Material>& materials() const noexcept { return materials_; }
  /// One haptic tick.
  void step(const SurfaceSettings& settings, double period) noexcept;

 private:
  struct Transition {
    double* value;
    double target, near;  // near: difference at which the target counts as reached
  };
  SettingsTaker taker_;
  std::vector<Material> materials_;
  std::vector<Transition> transitions_;
};

}  // namespace presa
