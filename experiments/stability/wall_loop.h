#pragma once
#include <deque>

#include "framework/device/device.h"

/// The sampled-data loop of a device and a virtual wall: exact plant and exact bound.
namespace presa::stability {

/// Device of mass m and viscous damping b under force that is held between samples: m x'' + b x' = bias - F.
struct WallPlant {
  double mass = 0, damping = 0;  ///< [kg, N s/m]
  double period = 0.001;         ///< of the loop [s]
  int delay = 0;                 ///< whole samples from reading the position to the force that follows from it
};

/// Largest modulus of an eigenvalue of the loop closed by a spring of `stiffness`: below 1 it settles.
double spectralRadius(const WallPlant& plant, double stiffness);
/// The smallest stiffness at which the loop has an eigenvalue on the unit circle [N/m].
double largestStableStiffness(const WallPlant& plant);

/// The plant as a device that moves along x and leans on a wall, stepped exactly (zero-order hold). Until `release` it is
/// held at start_x.
class WallDevice final : public Device {
 public:
  struct Setup {
    WallPlant plant;
    double bias = 0;     ///< constant force of the hand [N]
    double start_x = 0;  ///< [m]
    double release = 0;  ///< [s]
    Vec3 p_WO = Vec3::Zero();
  };
  explicit WallDevice(const Setup& setup);
  FingerInput read(const Tick& tick) noexcept override;
  void write(const Vec3& f_H_W, const Tick& tick) noexcept override;

 private:
  Setup setup_;
  double x_, v_ = 0;
  double held_ = 0;             ///< force on the finger until the next sample [N]
  std::deque<double> pending_;  ///< delayed forces, oldest first; always plant.delay of them
};

}  // namespace presa::stability
