#pragma once
#include <memory>
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// Where free bodies that touch nothing are: parabolas, and torque-free rotation integrated to rounding (constant angular
/// momentum, Runge–Kutta 4 at 1 mrad a step). The reference of scenes whose answer is known.
class FreeMotion {
 public:
  explicit FreeMotion(std::shared_ptr<const World> world);
  /// Pose of body i (index into Scene::bodies); times must not fall from call to call.
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
