#pragma once
#include <cstdint>
#include <random>

#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// Where a finger goes that wanders over a body, presses and slides, from a seed: mostly to points up to 10 mm below
/// the surface or little above it, sometimes straight through the body, at 0.02 to 1 m/s. It is a mass on a spring that
/// follows such a way, and so yields to what it feels; with `stiff` it goes exactly there.
class Wanderer {
 public:
  Wanderer(const TriMesh& mesh, std::uint64_t seed, bool stiff);

  const Vec3& position() const { return x_; }
  /// One tick of 1 ms under the force that it felt.
  const Vec3& next(const Vec3& f_H_W);

 private:
  double uniform(double from, double to);
  void choose();

  const TriMesh& mesh_;
  std::mt19937_64 random_;
  bool stiff_;
  AxisBox room_;
  Vec3 target_, goal_ = Vec3::Zero();  ///< the way's end, and where on it the hand is
  double speed_ = 0.1;
  int rest_ = 0;  ///< ticks before it goes on
  Vec3 x_, v_ = Vec3::Zero();
};

}  // namespace presa::test
