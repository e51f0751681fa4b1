#pragma once
#include <Eigen/Core>

#include "devices/hand/motion.h"
#include "framework/core/math/random.h"
#include "framework/core/math/spatial.h"

/// An admittance device [vanderLinde2002]: a stiff drive that no hand can push by itself. A sensor in the grip measures the hand's force;
/// a virtual mass moves under that force and the rendered one, and a velocity servo makes the grip follow:
///     M r' + B r = F_hand + F_rendered,   v' = 2 pi f (r - v),   x' = v
namespace presa::admittance {

struct Parameters {
  double inertia = 2;       ///< M of the virtual mass [kg]
  double viscosity = 20;    ///< B of the virtual damper [N s/m]
  double bandwidth = 50;    ///< f of the servo, first order [Hz]
  double noise = 0.01;      ///< of the force sensor, standard deviation of each sample and axis [N]
  double most_force = 100;  ///< range of the sensor, each axis [N]
  double most_speed = 1;    ///< of the virtual mass and of the grip [m/s]
  Vec3 centre = Vec3::Zero(), half_travel{0.2, 0.2, 0.2};  ///< of the box between the end stops, in W [m]
};

/// The hand in the grip for one period: m x'' = k (target - x) + b (target_velocity - x') + force - what the sensor measures.
struct Hold {
  FingerImpedance hand;
  Vec3 target = Vec3::Zero(), target_velocity = Vec3::Zero(), force = Vec3::Zero();
};

/// Thread: haptic; nonblocking. Everything in W.
class Drive {
 public:
  /// `period`: of the haptic ticks [s]; the controller samples its sensor every kSample at the latest.
  Drive(const Parameters& parameters, double period, RandomStream noise);

  /// At rest there.
  void place(const Vec3& x) noexcept;
  /// The rendered force from now on [N].
  void command(const Vec3& f) noexcept { rendered_ = f; }
  /// One period with this hand in the grip.
  void advance(const Hold& hold) noexcept;

  const Vec3& position() const noexcept { return x_; }
  const Vec3& velocity() const noexcept { return v_; }
  /// Force of the hand on the grip at the last sample, as it was, not as it was measured [N].
  const Vec3& handForce() const noexcept { return hand_force_; }

  static constexpr double kSample = 0.25e-3;  ///< [s]

 private:
  void step(const Vec3& force) noexcept;
  void stopAtEnds() noexcept;

  Parameters parameters_;
  RandomStream noise_;
  int samples_;                      // in a period
  Eigen::Matrix<double, 3, 4> map_;  // (x, v, r, force) to (x, v, r) after a sample
  Vec3 x_ = Vec3::Zero(), v_ = Vec3::Zero(), r_ = Vec3::Zero();
  Vec3 rendered_ = Vec3::Zero(), hand_force_ = Vec3::Zero();
};

/// Stiffest sampled wall, its force held from tick to tick, at which grip and hand still come to rest; 0: not even without [N/m].
double stiffestWall(const Parameters& parameters, const FingerImpedance& hand, double period);

}  // namespace presa::admittance
