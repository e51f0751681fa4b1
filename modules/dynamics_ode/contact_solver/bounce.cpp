#include "modules/dynamics_ode/contact_solver/bounce.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/index.h"
#include "modules/dynamics_ode/contact_joints.h"

namespace presa::ode {
namespace {

using ContactBody = ContactProblem::Body;
using Contact = ContactProblem::Contact;

constexpr int kMaxSweeps = 100;
constexpr double kSettled = 1e-10;  // change of an impulse in a sweep, in relation to the largest
constexpr double kMet = 0.01;       // part of the way in a step

/// Of B against A at the contact, with what `of` gives for a body and its lever arm.
template <class Of>
Vec3 relative(const Contact& c, Of of) {
  return c.A == ContactProblem::kFixed ? of(c.B) : Vec3(of(c.B) - of(c.A));
}

Mat3 inverseInertia(const ContactBody& body) {
  const Mat3 R = body.q_WB.toRotationMatrix();
  return R * body.inverse_inertia_B * R.transpose();
}

void push(ContactBody& body, const Vec3& r_W, const Vec3& impulse) {
  body.v_WCm += impulse / body.mass;
  body.w_WB += inverseInertia(body) * r_W.cross(impulse);
}

double inverseMass(const ContactBody& body, const Vec3& r_W, const Vec3& direction) {
  const Vec3 turn = r_W.cross(direction);
  return 1 / body.mass + turn.dot(inverseInertia(body) * turn);
}

}  // namespace

Bounce::Bounce(std::size_t bodies, std::size_t contacts) {
  begin_.reserve(bodies);
  solved_.reserve(bodies);
  impacts_.reserve(contacts);
}

Vec3 Bounce::armOf(std::int32_t body, const Contact& c) const { return c.point() - begin_[index(body)].p_WCm; }

void Bounce::before(const ContactProblem& problem, double h) {
  h_ = h;
  begin_ = problem.bodies;
  impacts_.clear();
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Contact& c = problem.contacts[i];
    if (!(c.restitution > 0)) continue;
    const double closing = -c.nhat_AB_W.dot(relative(
        c, [&](std::int32_t b) { return Vec3(begin_[b].v_WCm + begin_[b].w_WB.cross(c.p_W - begin_[b].p_WCm)); }));
    const double gains = -c.nhat_AB_W.dot(
        relative(c, [&](std::int32_t b) { return Vec3(begin_[index(b)].force_W / begin_[index(b)].mass); }));
    const double square = closing * std::abs(closing) + 2 * gains * std::max(0.0, c.gap);
    if (!(square > 0)) continue;
    const double speed = std::sqrt(square);
    if (speed > std::max(kMinBounce, 2 * h * std::abs(gains))) impacts_.push_back({i, speed, kMet * h * speed});
  }
}

// Of B against A at the contact.
Vec3 Bounce::velocityAt(const ContactProblem& problem, const Contact& c) const {
  return relative(c, [&](std::int32_t b) {
    const ContactBody& body = problem.bodies[index(b)];
    return Vec3(body.v_WCm + body.w_WB.cross(armOf(b, c)));
  });
}

double Bounce::massAlong(const ContactProblem& problem, const Contact& c, const Vec3& direction) const {
  const auto inverse = [&](std::int32_t b) {
    if (b == ContactProblem::kFixed) return 0.0;
    const ContactBody& body = problem.bodies[index(b)];
    return inverseMass(body, armOf(b, c), direction);
  };
  return 1 / (inverse(c.A) + inverse(c.B));
}

void Bounce::give(ContactProblem& problem, const Contact& c, const Vec3& impulse) const {
  for (const std::int32_t b : {c.A, c.B}) {
    if (b == ContactProblem::kFixed) continue;
    ContactBody& body = problem.bodies[index(b)];
    push(body, armOf(b, c), b == c.B ? impulse : Vec3(-impulse));
  }
}

// Projected Gauss-Seidel on the added impulses. Returns the largest change in relation to the largest impulse.
double Bounce::sweep(ContactProblem& problem) {
  double change = 0, largest = 0;
  for (Impact& impact : impacts_) {
    const Contact& c = problem.contacts[impact.contact];
    const double wanted = c.restitution * impact.speed - c.nhat_AB_W.dot(velocityAt(problem, c));
    const double more = std::max(-impact.impulse, wanted * massAlong(problem, c, c.nhat_AB_W));
    impact.impulse += more;
    give(problem, c, more * c.nhat_AB_W);
    change = std::max(change, std::abs(more));
    largest = std::max(largest, impact.impulse);
    if (!(c.mu > 0)) continue;
    const Vec3 u = velocityAt(problem, c), slip = u - u.dot(c.nhat_AB_W) * c.nhat_AB_W;
    Vec3 friction = impact.friction;
    if (!slip.isZero()) friction -= massAlong(problem, c, slip.normalized()) * slip;
    const double size = friction.norm(), limit = c.mu * impact.impulse;
    if (size > limit) friction *= limit / size;
    give(problem, c, friction - impact.friction);
    change = std::max(change, (friction - impact.friction).norm());
    impact.friction = friction;
  }
  return largest > 0 ? change / largest : 0;
}

// The energy that may be left: that at the start and the work of external forces. It is quadratic in the part of the
// added impulses.
void Bounce::boundEnergy(ContactProblem& problem) {
  double allowed = 0, solved = 0, slope = 0, curvature = 0;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const ContactBody &begin = begin_[i], &from = solved_[i], &to = problem.bodies[i];
    const auto spin = [](const ContactBody& a, const ContactBody& b) {
      return (a.q_WB.conjugate() * a.w_WB).dot(a.inertia_B * (b.q_WB.conjugate() * b.w_WB));
    };
    ContactBody change = to;
    change.v_WCm -= from.v_WCm;
    change.w_WB -= from.w_WB;
    allowed +=
        (begin.mass * begin.v_WCm.squaredNorm() + spin(begin, begin)) / 2 + begin.force_W.dot(to.p_WCm - begin.p_WCm);
    solved += (from.mass * from.v_WCm.squaredNorm() + spin(from, from)) / 2;
    slope += from.mass * from.v_WCm.dot(change.v_WCm) + spin(from, change);
    curvature += from.mass * change.v_WCm.squaredNorm() + spin(change, change);
  }
  const double excess = solved + slope + curvature / 2 - allowed;
  if (!(excess > 0 && curvature > 0)) return;
  const double room = std::max(0.0, allowed - solved);
  const double part = std::clamp((std::sqrt(slope * slope + 2 * curvature * room) - slope) / curvature, 0.0, 1.0);
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    ContactBody& body = problem.bodies[i];
    body.v_WCm = solved_[i].v_WCm + part * (body.v_WCm - solved_[i].v_WCm);
    body.w_WB = solved_[i].w_WB + part * (body.w_WB - solved_[i].w_WB);
  }
}

void Bounce::fallExactly(ContactProblem& problem) const {
  const auto pushes = [](const Contact& c) { return !c.f_B_W.isZero(); };
  if (!problem.joints.empty() || !problem.fingers.empty() || !problem.motors.empty()) return;
  if (std::ranges::any_of(problem.contacts, pushes)) return;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    ContactBody& body = problem.bodies[i];
    body.p_WCm = begin_[i].p_WCm + h_ / 2 * (begin_[i].v_WCm + body.v_WCm);
  }
}

void Bounce::after(ContactProblem& problem) {
  std::erase_if(impacts_, [&](const Impact& impact) {
    const Contact& c = problem.contacts[impact.contact];
    double near = impact.near;
    const Vec3 moved = relative(c, [&](std::int32_t b) {
      const ContactBody& body = problem.bodies[index(b)];
      const double turn = h_ * body.w_WB.norm();
      near += armOf(b, c).norm() * turn * turn / 2;  // what the lever arm hides as it turns
      return Vec3(body.p_WCm - begin_[index(b)].p_WCm + h_ * body.w_WB.cross(armOf(b, c)));
    });
    return c.gap + c.nhat_AB_W.dot(moved) > near;
  });
  if (impacts_.empty()) return fallExactly(problem);
  solved_ = problem.bodies;
  for (int i = 0; i < kMaxSweeps && sweep(problem) > kSettled; ++i) {
  }
  boundEnergy(problem);
}

}  // namespace presa::ode
