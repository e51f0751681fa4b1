#pragma once
#include <memory>
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// Analytic motion of bodies that touch nothing: parabolas, and torque-free rotation with constant angular momentum,
/// integrated to rounding by Runge-Kutta 4 at 1 mrad per step. Reference for scenes with a known solution.
class FreeMotion {
 public:
  explicit FreeMotion(std::shared_ptr<const World> world);
  /// Pose of body i (index into Scene::bodies) at `time` [s]; times must not decrease between calls.
  Pose at(std::size_t i, double time);

 private:
  struct Rotation {
    Quat q_WB = Quat::Identity();
    Vec3 momentum_W = Vec3::Zero();
    double time = 0, step = 1e-3;
  };
  void turn(std::size_t i, double time);

  std::shared_ptr<const World> world_;
  std::vector<Rotation> rotations_;
};

}  // namespace presa
