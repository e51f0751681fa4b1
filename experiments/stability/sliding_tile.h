#pragma once
#include <array>

#include "framework/core/math/spatial.h"

namespace presa::stability {

/// Reference for a square tile that slides and spins on a plane under Coulomb friction: a rigid plate on four corners.
/// The corner loads are linear over the plate and balance the tilting moment of friction; integrated by classical
/// Runge-Kutta in steps of 0.1 ms. Plane: z = 0, normal load along -z.
class SlidingTile {
 public:
  struct State {
    Eigen::Vector2d v = Eigen::Vector2d::Zero();  ///< of the centre [m/s]
    double angle = 0, spin = 0;                   ///< about z [rad, rad/s]
  };
  struct Model {
    double edge = 0.1, thickness = 0.002, friction = 0.5;  ///< [m, m, -]
    Vec3 gravity = Vec3::Zero();                           ///< in the frame of the plane [m/s^2]
  };
  SlidingTile(const Model& model, const State& start) : model_(model), state_(start) {}
  /// Advances to `time` [s] and returns the state there.
  const State& at(double time);

 private:
  State rate(const State& state) const;
  Model model_;
  State state_;
  double time_ = 0;
};

}  // namespace presa::stability
