#pragma once
#include <functional>
#include <vector>

#include "framework/core/math/spatial.h"

/// A reference that shares no code with the method under test: no solver, no constraints, no contact detection, no
/// engine.
namespace presa::stability {

/// A rigid body on springs of equal stiffness k, from body-fixed points a_i to fingertips H_i on known paths:
///   f_i = k (H_i(t) - (p + R a_i)),   m p'' = m g + sum f_i,   L' = sum (R a_i) x f_i,   w = R J^-1 R^T L,   R' = [w]
///   R
/// Stepped by symplectic Euler at 10 us, far below the shortest period (1.4 ms for 1 g on 2 x 10 N/mm). This models the
/// grasp exactly as long as no finger slips or releases. a_i are the fingertips' centres at the surface.
class HeldBody {
 public:
  struct Parameters {
    double mass = 0;                ///< [kg]
    Vec3 inertia = Vec3::Zero();    ///< principal, about the centre of mass, in the body frame [kg m^2]
    double stiffness = 0;           ///< of each finger [N/m]
    Vec3 gravity = Vec3::Zero();    ///< [m/s^2]
    std::vector<Vec3> attachments;  ///< a_i, body frame [m]
    /// Position of a fingertip in W [m] at a time [s].
    std::function<Vec3(std::size_t finger, double time)> fingertip;
  };
  HeldBody(Parameters parameters, double time, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB);

  /// Advances to `time` [s] in steps of `kStep`.
  void advance(double time);
  /// Lets the body come to rest for `duration` [s] in steps of `kStep`, by stopping it whenever it slows down. The
  /// fingertips must not move.
  void relax(double duration);
  /// Force of a fingertip on the body, W [N].
  Vec3 force(std::size_t finger) const;
  const Pose& pose() const noexcept { return X_WB_; }

  static constexpr double kStep = 1e-5;  ///< [s]

 private:
  void step();
  double time() const { return begin_ + static_cast<double>(steps_) * kStep; }
  double kineticEnergy() const;
  Vec3 angularVelocity() const;

  Parameters parameters_;
  double begin_;
  std::uint64_t steps_ = 0;
  Pose X_WB_;
  Vec3 v_, L_;
};

}  // namespace presa::stability
