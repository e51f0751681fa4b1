#pragma once
#include <optional>

#include "framework/core/math/spatial.h"
#include "framework/core/state/contact_exchange.h"

namespace presa::ode {

/// Pose and inertia of a free body at the start of a step.
struct BodyInertiaState {
  Pose X_WB;
  Vec3 p_WCm = Vec3::Zero();
  double inverse_mass = 0;
  Mat3 inverse_inertia_W = Mat3::Zero();
};

/// One finger contact as three rows of ODE's velocity constraint J v+ + cfm * force = rhs.
///
/// The haptic side renders f_H_W = k (p_WP - p_WH) (+ damping) on the finger, with the proxy P fixed to the body; the
/// body receives the negative. With the displacement s = X_WB p_BP - p_WH taken at the *start* of the step, split into
/// depth = s . nhat and t = s - depth nhat, and n_in = -nhat (into the body), t1 = -t/|t|, the rows are
///   n_in . v+ + cfm f_n = erp/h depth + n_in . v_H     erp = hk/(hk+d), cfm = 1/(hk+d)
///   t1   . v+ + slip f_1 = |t|/h      + t1   . v_H     |f_1| <= mu f_n,  slip = 1/(hk)
///   t2   . v+ + slip f_2 =              t2   . v_H     |f_2| <= mu f_n,  t2 = n_in x t1
/// where v+ is the velocity of P at the end of the step and v_H the mean velocity of the HIP in it. With that at its
/// start, the force would lack k h^2 a / 2 at the finger's acceleration a: 5 % of the grip on a cube that is shaken.
/// A friction law may give the tangential rows a stiffness k_t and a damping d_t of their own
/// (FingerContact::tangential_ratio); then slip = 1/(h k_t + d_t), |t|/h is weighted by h k_t/(h k_t + d_t), and t is
/// the displacement at which k_t gives the force of the sample. The solution is
///   f_n = k (depth at the end of the step) + d (closing velocity),
/// an implicit spring-damper; tangentially the spring alone, as on the haptic side. At rest f_n = k depth and
/// f_1 = k |t| exactly. A finger that left the surface since its sample (depth < 0) either closes the gap within the
/// step or exerts no force.
///
/// The force acts at P, not at the touched point one fingertip radius below it: the spring with energy k |P - H|^2 / 2
/// is attached to the body at P, so force and torque are its gradient and no motion of the body creates energy. A
/// fingertip that does not roll transmits exactly this moment.
struct FingerConstraint {
  Vec3 p_WP = Vec3::Zero();   ///< proxy, the point of application [m]
  Vec3 n_in = Vec3::UnitZ();  ///< into the body
  Vec3 t1 = Vec3::UnitX();    ///< first friction direction; t2 = n_in x t1
  double depth = 0;           ///< >= 0 [m]
  double erp = 0;             ///< normal row
  double cfm = 0;             ///< normal row [m/(N s)]
  double motion_n = 0;        ///< [m/s]
  double motion_1 = 0, motion_2 = 0;
  double slip = 0;        ///< cfm of the tangential rows [m/(N s)]
  double mu = 0;          ///< static while the proxy sticks, dynamic while it slips [-]
  double mu_dynamic = 0;  ///< coefficient after a stick-to-slip transition within the step [-]
  /// The same spring-damper in plain numbers, for a solver with steps of its own.
  struct Spring {
    double k = 0, d = 0, k_t = 0, d_t = 0;  ///< [N/m, N s/m]
    double depth = 0, stretch = 0;          ///< at the start, signed, and against t1 [m]
    Vec3 v_WH = Vec3::Zero();               ///< mean velocity of the HIP in the step [m/s]
  } spring;
  Vec3 expected_force_W = Vec3::Zero();  ///< force on the body at the start of the step, inside the friction cone [N]
};

/// Time in which a finger fades once its sample is older than `old_after` (ages::fingers) [s].
inline constexpr double kFingerFade = 0.020;
/// Weight of a finger: 1 up to the age `old_after`, then falling linearly to 0 over kFingerFade.
double fingerWeight(double age, double old_after);

/// Whether all numbers of the contact are finite and its normal is not degenerate.
bool isUsable(const FingerContact& contact);

/// One body's part of a contact that several bodies share as the contact of a finger of its own.
FingerContact contactOf(const FingerContact& contact, const ToolContact& part);

/// The rows of a usable `contact`, sampled `age` [s] before the step, for a step of `h` [s]. The HIP is extrapolated with
/// its velocity and acceleration [m/s^2], to the step over at most `old_after`. None when there is no contact
/// or it has faded.
std::optional<FingerConstraint> makeFingerConstraint(const FingerContact& contact, const Vec3& acceleration_W,
                                                     const BodyInertiaState& body, double age, double old_after,
                                                     double h);

}  // namespace presa::ode
