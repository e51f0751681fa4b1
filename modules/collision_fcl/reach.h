#pragma once

/// Reach of a finger and of a body until the next neighbourhood arrives: a haptic tick must find in its neighbourhood
/// everything that it can touch. Too small values cost time, not accuracy, because the tick then examines all bodies
/// itself.
namespace presa::reach {

/// Allowance for accelerations of finger and bodies during the horizon [m/s^2]. A grasping hand stays below 10; a
/// dropped object accelerates at 9.81.
inline constexpr double kAcceleration = 20;
/// Extra margin of a cut of the tree, so that a neighbourhood serves for several queries [m].
inline constexpr double kMargin = 0.03;
/// Radius that a tick examines around its proxy, in fingertip radii: leaves room for being pushed out of a moving body.
inline constexpr double kFingertips = 1.1;
/// A neighbourhood is made from poses at the start of a collision period, published at the latest at its end, and used
/// until the next one [collision periods].
inline constexpr double kCollisionPeriods = 2;
/// The object state may lag by one dynamics step [dynamics periods].
inline constexpr double kDynamicsPeriods = 1;

/// Maximum distance travelled at `speed` [m/s] within `horizon` [s], including the acceleration allowance [m].
inline double travel(double speed, double horizon) { return speed * horizon + 0.5 * kAcceleration * horizon * horizon; }

}  // namespace presa::reach
