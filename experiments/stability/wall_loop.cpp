#include "experiments/stability/wall_loop.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace presa::stability {
namespace {

/// Exact discretisation over one period: x and v from the initial v, and from a unit force held over the period.
struct ZeroOrderHold {
  double x_of_v, v_of_v, x_of_force, v_of_force;
};

ZeroOrderHold exactStep(const WallPlant& plant) {
  const double tau = plant.mass / plant.damping, gone = -std::expm1(-plant.period / tau);
  return {tau * gone, 1 - gone, (plant.period - tau * gone) / plant.damping, gone / plant.damping};
}

}  // namespace

double spectralRadius(const WallPlant& plant, double stiffness) {
  // state: x, v, then the last `delay` positions; the force is -stiffness times the oldest
  const ZeroOrderHold step = exactStep(plant);
  const int n = 2 + plant.delay, oldest = plant.delay == 0 ? 0 : n - 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  A.topLeftCorner(2, 2) << 1, step.x_of_v, 0, step.v_of_v;
  A(0, oldest) -= step.x_of_force * stiffness;
  A(1, oldest) -= step.v_of_force * stiffness;
  for (int i = 2; i < n; ++i) A(i, i == 2 ? 0 : i - 1) = 1;
  return A.eigenvalues().cwiseAbs().maxCoeff();
}

double largestStableStiffness(const WallPlant& plant) {
  double low = 0, high = 1;
  while (spectralRadius(plant, high) < 1) low = high, high *= 1.02;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (spectralRadius(plant, middle) < 1 ? low : high) = middle;
  }
  return low;
}

WallDevice::WallDevice(const Setup& setup)
    : setup_(setup), x_(setup.start_x), pending_(static_cast<std::size_t>(setup.plant.delay), 0.0) {}

FingerInput WallDevice::read(const Tick& tick) noexcept {
  if (tick.time > setup_.release) {
    const ZeroOrderHold step = exactStep(setup_.plant);
    const double force = setup_.bias + held_;
    x_ += step.x_of_v * v_ + step.x_of_force * force;
    v_ = step.v_of_v * v_ + step.v_of_force * force;
  }
  return {setup_.p_WO + x_ * Vec3::UnitX(), v_ * Vec3::UnitX(), -1, true};
}

void WallDevice::write(const Wrench& F_H_W, const Tick&) noexcept {
  pending_.push_back(F_H_W.f.x());
  held_ = pending_.front();
  pending_.pop_front();
}

}  // namespace presa::stability
