#pragma once

namespace presa {

/// Stiffness of a layered material over the depth, as shares of that of its core material: `skin` down to `thickness`,
/// then growing linearly over `transition` to `core`, which stays.
///
///   tangent(z)   the stiffness k at the depth z: the slope of the force
///   force(z)     integral of k from 0 to z [m]: times the material's stiffness a force [N]
///   secant(z)    force(z) / z, the mean stiffness down to z; it never falls, because k never does
///
/// Thread: any; nonblocking. Depths are finite; below 0 the skin goes on.
class LayerProfile {
 public:
  /// Throws std::invalid_argument if the core is softer than the skin. 0 < skin <= 1, core <= 1, thickness >= 0 [m],
  /// transition > 0 [m].
  LayerProfile(double skin, double core, double thickness, double transition);

  double tangent(double depth) const noexcept;
  double force(double depth) const noexcept;
  double secant(double depth) const noexcept;

 private:
  double skin_, core_;             // [-]
  double thickness_, transition_;  // [m]
};

}  // namespace presa
