#pragma once
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "framework/core/math/spatial.h"
#include "experiments/study/prescribed_finger.h"

/// A hand that plays with a body, different with every seed.
namespace presa::stability {

/// Ways of two fingertips, made up while it goes on: grab and shake, grab and throw, press from above, grope about clumsily,
/// and between them retreat and wait. Each way is a chain of quintic pieces, so that position, velocity and acceleration are
/// continuous. The same seed and the same body give the same ways.
class RandomHand {
 public:
  struct Place {
    double half = 0;           ///< half edge of the cube [m]
    double radius = 0;         ///< of the fingertips [m]
    Vec3 low, high;            ///< what the fingertips may reach for [m]
    std::array<Vec3, 2> home;  ///< where they wait, away from everything [m]
    double stiffness = 0;      ///< of hand and surface in series: depth of a wanted force [N/m]
  };
  RandomHand(const Place& place, std::uint64_t seed);

  /// Looks where the body is; plans the next game when one is over. Before state(), once a haptic tick.
  void look(double time, const Pose& X_WB);
  PrescribedFinger::State state(std::size_t finger, double time) const;
  /// It has waited long enough for the body to have come to rest.
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
