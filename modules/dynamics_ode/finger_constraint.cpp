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

}  // namespace

bool isUsable(const FingerContact& c) {
  return c.p_WH.allFinite() && c.v_WH.allFinite() && c.p_BP.allFinite() && c.p_BC.allFinite() && c.nhat_B.allFinite() &&
         std::isfinite(c.stiffness) && std::isfinite(c.damping) && std::isfinite(c.friction_static) &&
         std::isfinite(c.friction_dynamic) && c.nhat_B.squaredNorm() > 0.25;
}

FingerContact contactOf(const FingerContact& contact, const ContactPart& part) {
  FingerContact own = contact;
  own.body = part.body;
  own.p_WH = contact.p_WP - part.stretch_W;
  own.p_BP = own.p_BC = part.p_BP;
  own.nhat_B = part.nhat_B;
  own.part_count = 0;
  return own;
}

double fingerWeight(double age, double old_after) { return std::clamp(1 - (age - old_after) / kFingerFade, 0.0, 1.0); }

std::optional<FingerConstraint> makeFingerConstraint(const FingerContact& contact, const BodyInertiaState& body,
                                                     double age, double old_after, double h) {
  if (contact.mode == ContactMode::kNone) return std::nullopt;
  const double weight = fingerWeight(age, old_after);
  const double k = weight * contact.stiffness;
  const double d = weight * std::max(0.0, contact.damping);
  if (!(k > 0)) return std::nullopt;

  FingerConstraint row;
  row.p_WP = body.X_WB * contact.p_BP;
  const Vec3 nhat = (body.X_WB.q * contact.nhat_B).normalized();
  const Vec3 p_WH = contact.p_WH + std::clamp(age, 0.0, old_after) * contact.v_WH;
  const Vec3 stretch = row.p_WP - p_WH;
  const double depth = stretch.dot(nhat);
  const Vec3 tangential = stretch - depth * nhat;
  const double length = tangential.norm();
  row.n_in = -nhat;
  row.t1 = length > kNoStretch ? Vec3(-tangential / length) : nhat.unitOrthogonal();
  const Vec3 t2 = row.n_in.cross(row.t1);

  const double hk_d = h * k + d;
  row.erp = h * k / hk_d;
  row.cfm = 1 / hk_d;
  row.depth = std::max(0.0, depth);
  row.motion_n = row.n_in.dot(contact.v_WH) + row.erp / h * std::min(0.0, depth);
  row.slip = 1 / (h * k);
  row.motion_1 = length / h + row.t1.dot(contact.v_WH);
  row.motion_2 = t2.dot(contact.v_WH);
  row.mu = std::max(0.0, contact.mode == ContactMode::kSlip ? contact.friction_dynamic : contact.friction_static);
  row.mu_dynamic = std::clamp(contact.friction_dynamic, 0.0, row.mu);
  row.expected_force_W = k * (row.depth * row.n_in + std::min(length, row.mu * row.depth) * row.t1);
  return row;
}

}  // namespace presa::ode
