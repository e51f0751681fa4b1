#pragma once
#include <deque>

#include "framework/device/device.h"

/// The sampled-data loop of a device and a virtual wall, with the exact plant and the exact stability bound.
namespace presa::stability {

/// A device of mass m and viscous damping b with zero-order hold of the force: m x'' + b x' = bias - F.
struct WallPlant {
  double mass = 0, damping = 0;  ///< [kg, N s/m]
  double period = 0.001;         ///< of the loop [s]
  int delay = 0;                 ///< whole samples between reading a position and applying its force
};

/// Spectral radius of the loop closed by a spring of `stiffness`; below 1 it is stable.
double spectralRadius(const WallPlant& plant, double stiffness);
/// The stiffness at which the spectral radius reaches 1 [N/m].
double largestStableStiffness(const WallPlant& plant);

/// The plant as a device along x that leans on a wall, stepped exactly (zero-order hold). It is held at start_x until
/// `release`.
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
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override;

 private:
  Setup setup_;
  double x_, v_ = 0;
  double held_ = 0;             ///< force on the finger until the next sample [N]
  std::deque<double> pending_;  ///< delayed forces, oldest first; always plant.delay entries
};

}  // namespace presa::stability
