#pragma once
#include <numbers>

namespace presa::percro {

/// One arm of the PERCRO two-contact-point interface [Bergamasco2006]. Every number is one of
///   PAPER     printed there,
///   INFERRED  the only or the best value that reproduces a published figure (see parameters.cpp),
///   GUESS     not in the paper; an engineer's estimate.
/// Constant after construction. SI.

/// Links and transmission [Bergamasco2006 fig. 1, eq. 1, 2].
struct Geometry {
  double length_min = 0.441;   ///< L of the retracted barrel [m] PAPER
  double length_max = 1.070;   ///< L of the fully extended barrel [m] PAPER
  double tilt_ratio = 0;       ///< tau_1, motor turns per turn of tilt q1 INFERRED from 55 to 130 um
  double yaw_ratio = 1;        ///< tau_2: the ratio of yaw q2 is tau_1 tau_2 PAPER
  double drum_radius = 0;      ///< r_b = 1 / tau_3 of the barrel's motor [m] INFERRED from the conditioning
  double tilt_range = 0.7854;  ///< max |q1| [rad] GUESS
  double yaw_range = 0.6981;   ///< max |q2| [rad] GUESS
};

struct Motors {
  double continuous_torque = 0;    ///< [N m] INFERRED: 4 N in the worst place and direction
  double peak_torque = 0;          ///< [N m] INFERRED: 10 N there
  double thermal_time = 30;        ///< of the winding [s] GUESS
  double current_bandwidth = 500;  ///< of the first-order current loop [Hz] GUESS
  double rotor_inertia = 1.4e-5;   ///< [kg m^2] GUESS: iron-less brushed motor of this torque
  int counts = 4000;               ///< encoder counts per turn of a motor PAPER
  bool counted = true;             ///< false: the encoders have no steps, see properties.h
  double count() const { return 2 * std::numbers::pi / counts; }  ///< [rad]
};

struct Masses {
  double barrel = 0;              ///< moves with the tip [kg] INFERRED from 70 to 80 Hz
  double barrel_setback = 0.35;   ///< distance of its centre of mass behind the tip [m] GUESS
  double barrel_inertia = 0.011;  ///< about that centre, transverse [kg m^2] GUESS
  double roll_inertia = 1e-4;     ///< about the axis of the barrel [kg m^2] GUESS
  double counterweight = 0.6;     ///< the barrel's motor, behind the axes [kg] GUESS
  double counterweight_arm = 0;   ///< [m] INFERRED: balances the fully extended barrel
  double tilt_inertia = 0.01;     ///< of the parts that rotate with q1 only [kg m^2] GUESS
  double yaw_inertia = 0.01;      ///< of the parts that rotate with q2, without barrel and counterweight [kg m^2] GUESS
};

/// Compliance between the joints, which the encoders measure, and the tip.
struct Structure {
  double axial_stiffness = 23.74e3;  ///< along the barrel [N/m] PAPER
  double bend_linear = 0;            ///< a1 of c = a1 L + a3 L^3, across the barrel [1/N] INFERRED: 13.5 N/mm at min L
  double bend_cubic = 0;             ///< a3 [1/(N m^2)] INFERRED: 1.5 N/mm at max L
  double damping_time = 0;  ///< damping = this x stiffness [s] INFERRED: 0.1 of critical, a GUESS, along the barrel

  double compliance(double length) const { return length * (bend_linear + bend_cubic * length * length); }
};

struct Friction {                         // at the joints
  double coulomb[3] = {0.05, 0.05, 0.2};  ///< [N m], [N m], [N] GUESS
  double viscous[3] = {0.02, 0.02, 0.5};  ///< [N m s], [N m s], [N s/m] GUESS
};

struct Parameters {
  Geometry geometry;
  Motors motors;
  Masses masses;
  Structure structure;
  Friction friction;
};

/// Published figures from which the parameters are inferred and with which the model is compared.
namespace printed {
inline constexpr double kStepShort = 55e-6, kStepLong = 130e-6;    ///< resolution at L = 0.441 and 1.070 m [m]
inline constexpr double kContinuousForce = 4, kPeakForce = 10;     ///< worst place, all directions [N]
inline constexpr double kStiffShort = 13.5e3, kStiffLong = 1.5e3;  ///< across the barrel [N/m]
inline constexpr double kBandwidthLow = 70, kBandwidthHigh = 80;   ///< along the barrel [Hz]
inline constexpr double kBoxHeight = 0.3, kBoxWidth = 0.4, kBoxDepth = 0.6;  ///< of the workspace [m]
}  // namespace printed

/// The arm of the paper.
Parameters paperArm();

}  // namespace presa::percro
