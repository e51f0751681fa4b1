#pragma once
#include <functional>

#include "experiments/study/prescribed_finger.h"

namespace presa {

struct HandImpedance {
  double mass = 0.1;       ///< fingertip with thimble [kg]
  double stiffness = 500;  ///< of the hand behind it [N/m]
  double damping = 10;     ///< [N s/m]
};

/// What passed between device and hand so far, as seen at the device.
struct Transport {
  Vec3 force = Vec3::Zero();  ///< held now [N]
  double largest_step = 0;    ///< of the force, from one instant to the next [N]
  /// Given to the hand: sum of f(k-1) . (x(k) - x(k-1)), exact for a force that is held [Stramigioli2005] [J].
  double energy = 0;
};

/// A fingertip behind a hand whose far end goes a prescribed way: m x'' = k (x_T - x) + b (v_T - x') + f, f held between
/// writes; a passive hand, it pushes but does not correct. Integrated at 10 us on the clock of the world, so that it goes
/// on while the haptic loop is held up: ticks made up for afterwards all see it where it is by then.
class YieldingFinger final : public Device {
 public:
  /// `clock`: time in the world [s]; `transport`: filled as it goes. Both outlive the finger.
  YieldingFinger(const HandImpedance& hand, PrescribedFinger::Path target, const double& clock, Transport& transport);

  FingerInput read(const Tick& tick) noexcept override;
  void write(const Vec3& f_H_W, const Tick& tick) noexcept override;
  double damping() const override { return hand_.damping; }

 private:
  void advance() noexcept;

  HandImpedance hand_;
  PrescribedFinger::Path target_;
  const double& clock_;
  Transport& transport_;
  double time_ = 0, written_at_ = -1;
  Vec3 x_, v_ = Vec3::Zero();
  Vec3 force_before_ = Vec3::Zero();  // held before this instant
};

}  // namespace presa
