#include "modules/dynamics_ode/contact_joints.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/index.h"
#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {
namespace {

template <class Contact>
auto bodiesOf(const Contact& c) {
  return std::minmax(c.A, c.B);
}

}  // namespace

double pairFriction(const Material& a, const Material& b, double slip_speed) {
  return slip_speed < kRestSpeed ? std::sqrt(a.friction_static * b.friction_static)
                                 : std::sqrt(a.friction_dynamic * b.friction_dynamic);
}

Vec3 frictionDirection(const Vec3& nhat_AB, const Vec3& slip) {
  constexpr double kNoSlip = 1e-9;  // [m/s]
  if (!(slip.norm() > kNoSlip)) return nhat_AB.unitOrthogonal();
  // project again, so that the direction is perpendicular to the normal to the last bit
  const Vec3 direction = slip.normalized();
  return (direction - direction.dot(nhat_AB) * nhat_AB).normalized();
}

ContactJoints::ContactJoints(const Scene& scene, const OdeOptions& options, std::size_t contacts)
    : scene_(scene), options_(options) {
  joints_.reserve(contacts);
  feedback_.reserve(contacts);
  past_.reserve(contacts);
  next_.reserve(contacts);
  for (const Material& a : scene.materials) {
    for (const Material& b : scene.materials) {
      coefficients_.push_back({pairFriction(a, b, 0), pairFriction(a, b, 2 * kRestSpeed), a.rolling + b.rolling,
                               std::sqrt(a.restitution * b.restitution)});
    }
  }
}

const ContactJoints::Pair& ContactJoints::pairOf(const BodyContact& c) const {
  const std::size_t a = scene_.bodies[index(c.A)].material, b = scene_.bodies[index(c.B)].material;
  return coefficients_[a * scene_.materials.size() + b];
}

double ContactJoints::frictionOf(const Pair& pair, std::size_t i, const BodySet& bodies) const {
  if (pair.at_rest == pair.sliding) return pair.at_rest;
  return slip(i, bodies).norm() < kRestSpeed ? pair.at_rest : pair.sliding;
}

Vec3 ContactJoints::slip(std::size_t i, const BodySet& bodies) const {
  const BodyContact& c = contact(i);
  const Vec3 relative = bodies.velocityAt(index(c.B), c.p_W) - bodies.velocityAt(index(c.A), c.p_W);
  return relative - relative.dot(c.nhat_AB_W) * c.nhat_AB_W;
}

void ContactJoints::begin(const std::vector<BodyContact>& contacts, const BodySet& bodies, double h) {
  contacts_ = &contacts;
  h_ = h;
  joints_.assign(contacts.size(), {});
  feedback_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Pair& pair = pairOf(contact(i));
    joints_[i].mu = frictionOf(pair, i, bodies);
    joints_[i].rolling = pair.rolling;
    joints_[i].restitution = pair.restitution;
  }
  recall(bodies);
}

// Warm start from the last step. Both lists are sorted by pair; within a pair each contact takes the nearest past one
// that is not taken yet, relative to the centre of B.
void ContactJoints::recall(const BodySet& bodies) {
  auto run = past_.begin();
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const BodyContact& c = contact(i);
    while (run != past_.end() && bodiesOf(*run) < bodiesOf(c)) ++run;
    const Vec3 p_CmC = c.p_W - bodies.centreAtBegin(index(c.B));
    double nearest = 0.1 * bodies.extent(index(c.B));
    nearest *= nearest;
    Past* same = nullptr;
    for (auto past = run; past != past_.end() && bodiesOf(*past) == bodiesOf(c); ++past) {
      const double distance = (past->p_CmC_W - p_CmC).squaredNorm();
      if (distance > nearest || past->taken) continue;
      nearest = distance;
      same = &*past;
    }
    if (same == nullptr) continue;
    joints_[i].f_B_W = same->f_B_W;
    joints_[i].m_B_W = same->m_B_W;
    same->taken = true;
  }
}

dContact ContactJoints::make(const BodyContact& c, const Joint& joint, bool friction) const {
  dContact contact{};
  dSurfaceParameters& surface = contact.surface;
  surface.mode = dContactSoftERP | dContactSoftCFM;
  if (!joint.direction.isZero()) surface.mode |= dContactFDir1;
  if (joint.limit < 0) surface.mode |= dContactApprox1_1 | dContactApprox1_2;
  surface.mu = !friction ? 0 : joint.limit < 0 ? joint.mu : joint.limit;
  if (joint.slides) surface.mode |= dContactMu2;  // second direction: coefficient 0
  surface.soft_erp = options_.contact_erp;
  surface.soft_cfm = joint.cfm;
  assign(contact.geom.pos, c.p_W);
  assign(contact.geom.normal, c.nhat_AB_W);
  contact.geom.depth = std::max(0.0, c.depth);
  if (joint.restitution > 0) {
    surface.mode |= dContactBounce;
    surface.bounce = joint.restitution;
    surface.bounce_vel = kMinBounce;
  }
  if (c.depth < 0) {  // the bodies may close the gap within the step, but not overlap
    surface.mode |= dContactMotionN;
    surface.motionN = c.depth / h_;
  }
  assign(contact.fdir1, joint.direction);
  return contact;
}

void ContactJoints::addTo(Engine& engine, const BodySet& bodies, Islands& islands, const std::vector<char>& wanted,
                          bool friction) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const BodyContact& c = contact(i);
    if (wanted[islands.of(index(c.B))] == 0) continue;
    engine.addContact(make(c, joints_[i], friction), bodies.body(index(c.B)), bodies.body(index(c.A)),
                      friction ? &feedback_[i] : nullptr);
  }
}

void ContactJoints::readForces(Islands& islands, const std::vector<char>& solved) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (solved[islands.of(index(contact(i).B))] == 0) continue;
    joints_[i].f_B_W = toVec3(feedback_[i].f1);
  }
}

// Forces of paused bodies are kept for the step in which they go on.
void ContactJoints::end(const BodySet& bodies) {
  next_.clear();
  auto past = past_.begin();
  const auto keepPaused = [&](auto before) {
    for (; past != past_.end() && before(*past); ++past) {
      if (bodies.paused(index(past->B))) next_.push_back(*past);
    }
  };
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const BodyContact& c = contact(i);
    keepPaused([&](const Past& p) { return bodiesOf(p) < bodiesOf(c); });
    next_.push_back({c.A, c.B, c.p_W - bodies.centreAtBegin(index(c.B)), joints_[i].f_B_W, joints_[i].m_B_W});
  }
  keepPaused([](const Past&) { return true; });
  std::swap(past_, next_);
}

}  // namespace presa::ode
