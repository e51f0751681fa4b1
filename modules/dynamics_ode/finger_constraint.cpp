// Rows of the implicit finger coupling; equations and sign conventions in finger_constraint.h. Method: a spring-damper
// integrated with backward Euler, written as ODE's velocity constraint with erp and cfm. Invariants: at rest the normal
// force is k * depth and the tangential force k * |t|; tension is never transmitted; every coefficient is finite for a
// usable contact with k > 0.
#include "modules/dynamics_ode/finger_constraint.h"

#include <algorithm>
#include <cmath>

namespace presa::ode {
namespace {

constexpr double kNoStretch = 1e-12;  // smaller displacements have no direction [m]

// The mean velocity over a step is that in its middle. Less h / 12: on the haptic side the body moves along the chord of
// its path, in the mean a h^2 / 12 from it.
constexpr double kMeanAhead = 1.0 / 2 - 1.0 / 12;

// The force that the extrapolation adds comes back as acceleration of a finger with some mass: a loop of gain
// kMeanAhead h^2 k / mass, which hums above 1. At a low gain the whole acceleration counts, above it as much as keeps it.
Vec3 usable(const Vec3& a_WH, double k, double h) {
  constexpr double kFingerMass = 0.1;  // small hand on a light device [kg]
  constexpr double kGain = 0.25;
  return std::min(1.0, kGain * kFingerMass / (kMeanAhead * h * h * k)) * a_WH;
}

// Tangential displacement of the sample: stiffness times it is the rendered force.
Vec3 sampledStretch(const FingerContact& contact, const Vec3& nhat) {
  const Vec3 stretch = contact.p_WP - contact.p_WH;
  return stretch - stretch.dot(nhat) * nhat;
}

// What to add to the sample's displacement so that the law's own stiffness gives the rendered force without damping.
Vec3 lawDisplacement(const FingerContact& contact, const Vec3& nhat) {
  if (!(contact.tangential_ratio > 0)) return Vec3::Zero();
  return (1 / contact.tangential_ratio - 1) * sampledStretch(contact, nhat) -
         contact.damped_W / contact.tangential_ratio;
}

}  // namespace

bool isUsable(const FingerContact& c) {
  return c.p_WH.allFinite() && c.v_WH.allFinite() && c.p_BP.allFinite() && c.p_BC.allFinite() && c.nhat_B.allFinite() &&
         std::isfinite(c.stiffness) && std::isfinite(c.damping) && std::isfinite(c.friction_static) &&
         std::isfinite(c.friction_dynamic) && std::isfinite(c.tangential_ratio) && c.tangential_ratio >= 0 &&
         c.damped_W.allFinite() && std::isfinite(c.tangential_damping) && c.tangential_damping >= 0 &&
         std::isfinite(c.twist) && std::isfinite(c.twist_stiffness) && std::isfinite(c.spin) &&
         c.nhat_B.squaredNorm() > 0.25;
}

FingerContact contactOf(const FingerContact& contact, const ToolContact& part) {
  FingerContact own = contact;
  own.body = part.body;
  own.p_WP = part.p_WP;
  own.p_WH = part.p_WP - part.stretch_W;
  own.v_WH = part.v_WH;
  own.stiffness = part.stiffness;
  own.damping = part.damping;
  own.p_BP = own.p_BC = part.p_BP;
  own.nhat_B = part.nhat_B;
  own.mode = part.mode;
  own.friction_static = part.friction_static;
  own.friction_dynamic = part.friction_dynamic;
  own.tangential_ratio = part.tangential_ratio;
  own.tangential_damping = part.tangential_damping;
  own.damped_W = part.damped_W;
  own.contact_count = 1;
  return own;
}

double fingerWeight(double age, double old_after) { return std::clamp(1 - (age - old_after) / kFingerFade, 0.0, 1.0); }

std::optional<FingerConstraint> makeFingerConstraint(const FingerContact& contact, const Vec3& acceleration_W,
                                                     const BodyInertiaState& body, double age, double old_after,
                                                     double h) {
  if (contact.mode == ContactMode::kNone) return std::nullopt;
  const double weight = fingerWeight(age, old_after);
  const double k = weight * contact.stiffness;
  const double d = weight * std::max(0.0, contact.damping);
  if (!(k > 0)) return std::nullopt;

  FingerConstraint row;
  row.p_WP = body.X_WB * contact.p_BP;
  const Vec3 nhat = (body.X_WB.q * contact.nhat_B).normalized();
  const Vec3 a_WH = usable(acceleration_W, k, h);
  const double ahead = std::clamp(age, 0.0, old_after);
  const Vec3 p_WH = contact.p_WH + ahead * (contact.v_WH + ahead / 2 * a_WH);
  const Vec3 v_WH = contact.v_WH + (ahead + kMeanAhead * h) * a_WH;
  const Vec3 stretch = row.p_WP - p_WH;
  const double depth = stretch.dot(nhat);
  const double k_t = contact.tangential_ratio * k, d_t = weight * contact.tangential_damping;
  Vec3 tangential = stretch - depth * nhat;
  if (contact.tangential_ratio != 1 || d_t > 0) tangential += lawDisplacement(contact, nhat);
  const double length = tangential.norm();
  row.n_in = -nhat;
  row.t1 = length > kNoStretch ? Vec3(-tangential / length) : nhat.unitOrthogonal();
  const Vec3 t2 = row.n_in.cross(row.t1);

  const double hk_d = h * k + d;
  row.erp = h * k / hk_d;
  row.cfm = 1 / hk_d;
  row.depth = std::max(0.0, depth);
  row.motion_n = row.n_in.dot(v_WH) + row.erp / h * std::min(0.0, depth);
  const double hk_t_d = h * k_t + d_t;
  const bool rubs = hk_t_d > 0;
  row.slip = rubs ? 1 / hk_t_d : 1 / (h * k);
  row.motion_1 = (rubs ? h * k_t / hk_t_d : 0.0) * (length / h) + row.t1.dot(v_WH);
  row.motion_2 = t2.dot(v_WH);
  row.mu = std::max(0.0, contact.mode == ContactMode::kSlip ? contact.friction_dynamic : contact.friction_static);
  if (!rubs) row.mu = 0;
  row.mu_dynamic = std::clamp(contact.friction_dynamic, 0.0, row.mu);
  row.spring = {k, d, k_t, d_t, depth, length, v_WH};
  row.expected_force_W =
      k * (row.depth * row.n_in + std::min(contact.tangential_ratio * length, row.mu * row.depth) * row.t1);
  if (d_t > 0) row.expected_force_W -= k * contact.damped_W;
  return row;
}

}  // namespace presa::ode
