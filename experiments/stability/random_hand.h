#pragma once
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "experiments/study/prescribed_finger.h"
#include "framework/core/math/spatial.h"

/// A hand that plays with a body at random, by seed.
namespace presa::stability {

/// Random paths of two fingertips, generated online: grab and shake, grab and throw, press from above, grope, and
/// retreat and wait in between. Each path is a chain of quintic pieces, so position, velocity and acceleration are
/// continuous. The same seed and the same motion of the body give the same paths.
class RandomHand {
 public:
  struct Place {
    double half = 0;           ///< half edge of the cube [m]
    double radius = 0;         ///< of the fingertips [m]
    Vec3 low, high;            ///< bounds of random targets [m]
    std::array<Vec3, 2> home;  ///< waiting positions, away from everything [m]
    double stiffness = 0;      ///< of hand and surface in series; converts a wanted force to a depth [N/m]
  };
  RandomHand(const Place& place, std::uint64_t seed);

  /// Reads the pose of the body and plans the next game when one is over. Call once per haptic tick, before state().
  void look(double time, const Pose& X_WB);
  PrescribedFinger::State state(std::size_t finger, double time) const;
  /// True once the hand has waited long enough for the body to come to rest.
  bool quiet(double time) const { return time >= quiet_from_ && time < game_end_; }
  int games() const noexcept { return games_; }

 private:
  struct Piece {
    double begin = 0, end = 0;
    std::array<Vec3, 2> from, to;
  };
  double uniform(double low, double high);
  Vec3 anywhere(const Vec3& around, double reach);
  std::array<Vec3, 2> around(const Pose& X_WB, const Vec3& axis, double gap, const Vec3& shift) const;
  void go(double seconds, const std::array<Vec3, 2>& to);
  void grab(const Pose& X_WB);
  void press(const Pose& X_WB);
  void grope(const Pose& X_WB);
  void retreat();

  Place place_;
  std::mt19937_64 random_;
  std::vector<Piece> pieces_;
  std::array<Vec3, 2> last_;
  double end_ = 0, quiet_from_ = 0, game_end_ = 0;
  int games_ = 0;
};

}  // namespace presa::stability
