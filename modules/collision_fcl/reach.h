#pragma once

/// How far around a finger and a body the bodies near must be known, so that a haptic tick finds in its patch all that it can
/// touch until the next one arrives. Too small costs time, not accuracy: the tick then looks at every body itself.
namespace presa::reach {

/// Allowance for what a finger's or a body's speed may gain during the horizon [m/s^2]. A grasping hand stays below 10, a
/// dropped object adds 9.81.
inline constexpr double kAcceleration = 20;
/// Around everything, so that a patch serves for a while [m].
inline constexpr double kMargin = 0.03;
/// What a tick looks at around its proxy, in fingertip radii: some room to be pushed out of a moving body.
inline constexpr double kFingertips = 1.1;
/// A patch is made from a pose at the start of a collision period, is published at latest at its end, and serves until
/// the next one is [collision periods].
inline constexpr double kCollisionPeriods = 2;
/// Object State may lag by one dynamics step [dynamics periods].
inline constexpr double kDynamicsPeriods = 1;

/// Largest way at `speed` [m/s] within `horizon` seconds [m].
inline double travel(double speed, double horizon) { return speed * horizon + 0.5 * kAcceleration * horizon * horizon; }

}  // namespace presa::reach
