#pragma once
#include <vector>

#include "framework/scene/open_surfaces.h"
#include "framework/core/state/surface_settings.h"

namespace presa {

/// The materials in force where commands may set them: each goes to what was asked for with a time constant, so that a finger that
/// presses feels no step. Per tick a force F from depth k x changes by less than F period / kTimeConstant: at 1 kHz 0.7 % of it.
/// Thread: haptic; nonblocking but for construction.
class CommandedSurfaces {
 public:
  static constexpr double kTimeConstant = 0.15;  ///< [s]

  explicit CommandedSurfaces(const Scene& scene);
  /// As Scene::materials; only what is open differs, and only once it was set.
  const std::vector<Material>& materials() const noexcept { return materials_; }
  /// One haptic tick.
  void step(const SurfaceSettings& settings, double period) noexcept;

 private:
  struct Way {
    double* value;
    double target, near;  // near: this close is there
  };
  SettingsTaker taker_;
  std::vector<Material> materials_;
  std::vector<Way> ways_;
};

}  // namespace presa
