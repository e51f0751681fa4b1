#pragma once
#include <cstdint>
#include <random>

#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// Random motion of a finger that wanders over a body, presses and slides: mostly to points up to 10 mm below the
/// surface or a little above it, sometimes straight through the body, at 0.02 to 1 m/s. A mass on a spring follows this
/// path, so it yields to the contact force; with `stiff` the finger follows it exactly.
class Wanderer {
 public:
  Wanderer(const TriMesh& mesh, std::uint64_t seed, bool stiff);

  const Vec3& position() const { return x_; }
  /// One tick of 1 ms under the contact force.
  const Vec3& next(const Vec3& f_H_W);

 private:
  double uniform(double from, double to);
  void choose();

  const TriMesh& mesh_;
  std::mt19937_64 random_;
  bool stiff_;
  AxisBox room_;
  Vec3 target_, goal_ = Vec3::Zero();  ///< end of the path, and the hand's position on it
  double speed_ = 0.1;
  int rest_ = 0;  ///< ticks of rest before the next move
  Vec3 x_, v_ = Vec3::Zero();
};

}  // namespace presa::test
