#pragma once
#include <functional>

#include "experiments/study/prescribed_finger.h"

namespace presa {

struct HandImpedance {
  double mass = 0.1;       ///< fingertip with thimble [kg]
  double stiffness = 500;  ///< of the hand that holds the fingertip [N/m]
  double damping = 10;     ///< [N s/m]
};

/// Force and energy at the device so far.
struct Transport {
  Vec3 force = Vec3::Zero();  ///< current force on the hand [N]
  double largest_step = 0;    ///< max change of the force between two instants [N]
  /// Energy delivered to the hand: sum of f(k-1) . (x(k) - x(k-1)), exact for a held force [Stramigioli2005] [J].
  double energy = 0;
};

/// A fingertip on a passive, compliant hand with a prescribed target x_T: m x'' = k (x_T - x) + b (v_T - x') + f, where
/// f is held between writes; the target does not react to forces. Integrated at 10 us on the world clock, so the hand
/// keeps moving while the haptic loop is stalled, and all catch-up ticks see its current position.
class CompliantFinger final : public Device {
 public:
  /// `clock`: world time [s]; `transport`: output of this finger. Both must outlive the finger.
  CompliantFinger(const HandImpedance& hand, PrescribedFinger::Path target, const double& clock, Transport& transport);

  FingerInput read(const Tick& tick) noexcept override;
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override;
  double damping() const override { return hand_.damping; }

 private:
  void advance() noexcept;

  HandImpedance hand_;
  PrescribedFinger::Path target_;
  const double& clock_;
  Transport& transport_;
  double time_ = 0, written_at_ = -1;
  Vec3 x_, v_ = Vec3::Zero();
  Vec3 force_before_ = Vec3::Zero();  // force held before the current instant
};

}  // namespace presa
