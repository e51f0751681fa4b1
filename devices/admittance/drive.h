#pragma once
#include <Eigen/Core>

#include "devices/hand/motion.h"
#include "framework/core/math/random.h"
#include "framework/core/math/spatial.h"

/// Model of an admittance device [vanderLinde2002], which the hand cannot back-drive. A sensor in the grip measures the
/// hand's force; a virtual mass moves under that force plus the rendered one, and a velocity servo makes the grip
/// follow:
///     M r' + B r = F_hand + F_rendered,   v' = 2 pi f (r - v),   x' = v
namespace presa::admittance {

struct Parameters {
  double inertia = 2;      ///< M of the virtual mass [kg]
  double viscosity = 20;   ///< B of the virtual mass [N s/m]
  double bandwidth = 50;   ///< f of the first-order servo [Hz]
  double noise = 0.01;     ///< of the force sensor: standard deviation per sample and axis [N]
  double max_force = 100;  ///< range of the sensor per axis [N]
  double max_speed = 1;    ///< max speed of the virtual mass and of the grip [m/s]
  Vec3 centre = Vec3::Zero(), half_travel{0.2, 0.2, 0.2};  ///< box between the end stops, in W [m]
};

/// The hand at the grip during one period: m x'' = k (target - x) + b (target_velocity - x') + force - measured force.
struct Hold {
  FingerImpedance hand;
  Vec3 target = Vec3::Zero(), target_velocity = Vec3::Zero(), force = Vec3::Zero();
};

/// The simulated drive: sensor, virtual mass, servo, end stops. All in W. Thread: haptic; nonblocking.
class Drive {
 public:
  /// `period`: haptic period [s]; the controller samples its sensor at least every kSample.
  Drive(const Parameters& parameters, double period, RandomStream noise);

  /// Puts the grip at rest at x [m].
  void place(const Vec3& x) noexcept;
  /// Sets the rendered force [N], held until the next call.
  void command(const Vec3& f) noexcept { rendered_ = f; }
  /// Advances one period with this hand at the grip.
  void advance(const Hold& hold) noexcept;

  const Vec3& position() const noexcept { return x_; }
  const Vec3& velocity() const noexcept { return v_; }
  /// Force of the hand on the grip at the last sample, without sensor noise [N].
  const Vec3& handForce() const noexcept { return hand_force_; }

  static constexpr double kSample = 0.25e-3;  ///< max sampling period of the sensor [s]

 private:
  void step(const Vec3& force) noexcept;
  void stopAtEnds() noexcept;

  Parameters parameters_;
  RandomStream noise_;
  int samples_;                      // per period
  Eigen::Matrix<double, 3, 4> map_;  // (x, v, r, force) to (x, v, r) after a sample
  Vec3 x_ = Vec3::Zero(), v_ = Vec3::Zero(), r_ = Vec3::Zero();
  Vec3 rendered_ = Vec3::Zero(), hand_force_ = Vec3::Zero();
};

/// Max stiffness of a sampled wall (force held over a tick) at which grip and hand come to rest [N/m]; 0: unstable
/// without a wall.
double stiffestWall(const Parameters& parameters, const FingerImpedance& hand, double period);

}  // namespace presa::admittance
