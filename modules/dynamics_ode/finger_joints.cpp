#include "modules/dynamics_ode/finger_joints.h"

#include <algorithm>

#include "framework/scene/ages.h"
#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {
namespace {

dContact jointOf(const FingerConstraint& row) {
  dContact contact{};
  dSurfaceParameters& surface = contact.surface;
  surface.mode = dContactSoftERP | dContactSoftCFM | dContactMotionN | dContactFDir1 | dContactMotion1 |
                 dContactMotion2 | dContactSlip1 | dContactSlip2 | dContactApprox1_1 | dContactApprox1_2;
  surface.mu = row.mu;
  surface.soft_erp = row.erp;
  surface.soft_cfm = row.cfm;
  surface.motionN = row.motion_n;
  surface.motion1 = row.motion_1;
  surface.motion2 = row.motion_2;
  surface.slip1 = row.slip;
  surface.slip2 = row.slip;
  assign(contact.geom.pos, row.p_WP);
  assign(contact.geom.normal, row.n_in);  // ODE's normal points into the first attached body
  contact.geom.depth = row.depth;
  assign(contact.fdir1, row.t1);
  return contact;
}

// Compliance of the torsional motor: lets two fingertips on one axis share the load; 0.01 rad/s of slip at a firm
// grip's torque.
constexpr double kTorsionCfm = 1;  // [rad/s / (N m)]

}  // namespace

FingerJoints::FingerJoints(DynamicsSettings::Coupling coupling, const Scene& scene, dWorldID ode_world)
    : coupling_(coupling), old_after_(ages::fingers(scene.rates)) {
  const auto soft = [](const Material& material) { return material.torsional_radius > 0; };
  if (coupling != DynamicsSettings::Coupling::kSoft || scene.devices.empty()) return;
  if (std::ranges::none_of(scene.materials, soft)) return;
  for (const Body& body : scene.bodies) torsional_radius_.push_back(scene.materialOf(body).torsional_radius);
  for (std::size_t finger = 0; finger < scene.devices.size(); ++finger) {
    motors_.push_back(dJointCreateAMotor(ode_world, nullptr));
    dJointSetAMotorMode(motors_.back(), dAMotorUser);
    dJointSetAMotorNumAxes(motors_.back(), 1);
    dJointSetAMotorParam(motors_.back(), dParamCFM, kTorsionCfm);
  }
}

FingerJoints::~FingerJoints() {
  for (const dJointID motor : motors_) dJointDestroy(motor);
}

// Torsional friction of a fingertip that does not rotate, bounded by the normal force at the start of the step.
void FingerJoints::resistTurning(std::size_t finger, std::size_t body, const FingerConstraint& row,
                                 const BodySet& bodies) {
  const double normal = std::max(0.0, row.expected_force_W.dot(row.n_in));
  dJointAttach(motors_[finger], bodies.body(body), nullptr);
  dJointSetAMotorAxis(motors_[finger], 0, 0, row.n_in.x(), row.n_in.y(), row.n_in.z());
  dJointSetAMotorParam(motors_[finger], dParamVel, 0);
  dJointSetAMotorParam(motors_[finger], dParamCFM, kTorsionCfm);
  const double bound = torsional_radius_[body] * row.mu * normal;
  dJointSetAMotorParam(motors_[finger], dParamFMax, bound);
  torsion_.push_back({static_cast<std::int32_t>(body), true, row.n_in, 0, kTorsionCfm, bound});
}

// The torque of an oriented tool, the negative of what it feels. As with the tangential spring, the row is implicit:
// torque = k (twist + h (spin of the tool - spin of the body)), bounded by friction.
void FingerJoints::twist(std::size_t finger, std::size_t body, const FingerContact& contact, double age, double h,
                         BodySet& bodies) {
  const Vec3 nhat_W = bodies.pose(body).q * contact.nhat_B;
  const double k = contact.twist_stiffness, w_B = bodies.motion(body).w_WB.dot(nhat_W);
  const double twist = contact.twist + std::clamp(age, 0.0, old_after_) * (contact.spin - w_B);
  if (areForces()) {
    bodies.addAtCentre(body, Vec3::Zero(), k * contact.twist * nhat_W);
    return;
  }
  const double mu = contact.twist_slips ? contact.friction_dynamic : contact.friction_static;
  const double bound = torsional_radius_[body] * mu * contact.stiffness * std::max(0.0, contact.depth);
  dJointAttach(motors_[finger], bodies.body(body), nullptr);
  dJointSetAMotorAxis(motors_[finger], 0, 0, nhat_W.x(), nhat_W.y(), nhat_W.z());
  dJointSetAMotorParam(motors_[finger], dParamCFM, 1 / (h * k));
  dJointSetAMotorParam(motors_[finger], dParamVel, twist / h + contact.spin);
  dJointSetAMotorParam(motors_[finger], dParamFMax, bound);
  torsion_.push_back({static_cast<std::int32_t>(body), true, nhat_W, twist / h + contact.spin, 1 / (h * k), bound});
}

void FingerJoints::makeRoom(const ContactExchange& exchange) {
  if (motions_.size() < exchange.fingers.size()) motions_.resize(exchange.fingers.size());
  given_.resize(motions_.size(), Vec3::Zero());
  const std::size_t contacts = std::max(exchange.fingers.size(), exchange.contacts.capacity());
  if (feedback_.size() >= contacts) return;
  feedback_.resize(contacts);
  active_.reserve(contacts);
  torsion_.reserve(contacts);
}

void FingerJoints::estimateMotion(const ContactExchange& exchange) {
  for (std::size_t f = 0; f < exchange.fingers.size(); ++f) {
    Motion& motion = motions_[f];
    if (motion.time == exchange.time) continue;  // a further sub-step
    const Vec3& v_WH = exchange.fingers[f].v_WH;
    const double since = exchange.time - motion.time;
    const bool known = motion.time >= 0 && since > 0 && since <= old_after_;
    if (!v_WH.allFinite()) {
      motion = {};
      continue;
    }
    motion = {exchange.time, v_WH, known ? Vec3((v_WH - motion.v_WH) / since) : Vec3(Vec3::Zero())};
  }
}

void FingerJoints::add(std::size_t f, std::size_t body, const FingerContact& contact, FingerConstraint row,
                       const ContactExchange& exchange, double time, double h, BodySet& bodies) {
  const bool first = active_.empty() || active_.back().finger != f;
  feedback_[active_.size()] = {};
  if (contact.twist_stiffness > 0) {
    if (exchange.fingers[f].body == contact.body) twist(f, body, contact, time - exchange.time, h, bodies);
  } else if (!motors_.empty() && first) {  // a soft fingertip's motor acts on the first body that the finger touches
    resistTurning(f, body, row, bodies);
  }
  if (coupling_ == DynamicsSettings::Coupling::kAveraged && contact.contact_count < 2) {
    row.expected_force_W = (given_[f] - contact.impulse_H_W) / h;
  }
  if (areForces()) bodies.addForce(body, row.expected_force_W, row.p_WP);
  active_.push_back({f, body, row});
}

std::size_t FingerJoints::read(const ContactExchange& exchange, double time, double h, BodySet& bodies) {
  active_.clear();
  makeRoom(exchange);
  estimateMotion(exchange);
  for (const dJointID motor : motors_) dJointAttach(motor, nullptr, nullptr);
  torsion_.clear();
  const std::size_t invalid =
      forEachTouch(exchange, bodies, [&](std::size_t f, const FingerContact& contact, std::size_t body) {
        const auto row = makeFingerConstraint(contact, motions_[f].a_WH, bodies.inertiaState(body),
                                              time - exchange.time, old_after_, h);
        if (row) add(f, body, contact, *row, exchange, time, h, bodies);
      });
  // what fingers felt of something fixed, or of two bodies, is not passed on to what they touch next
  for (std::size_t f = 0; f < exchange.fingers.size(); ++f) given_[f] = exchange.fingers[f].impulse_H_W;
  return invalid;
}

void FingerJoints::addTo(Engine& engine, BodySet& bodies, Islands& islands, const std::vector<char>& wanted) {
  if (areForces()) return;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const Active& active = active_[i];
    if (wanted[islands.of(active.body)] == 0) continue;
    engine.addContact(jointOf(active.row), bodies.body(active.body), nullptr, &feedback_[i]);
  }
}

bool FingerJoints::stickToSlip(Islands& islands, std::vector<char>& wanted) {
  constexpr double kAtBound = 1 - 1e-6;
  std::fill(wanted.begin(), wanted.end(), 0);
  if (areForces()) return false;
  bool any = false;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    FingerConstraint& row = active_[i].row;
    const Vec3 force = toVec3(feedback_[i].f1);
    const double f_n = force.dot(row.n_in);
    const bool at_bound = f_n > 0 && force.dot(row.t1) >= kAtBound * row.mu * f_n;
    if (!at_bound || !(row.mu_dynamic < row.mu)) continue;
    row.mu = row.mu_dynamic;
    wanted[islands.of(active_[i].body)] = 1;
    any = true;
  }
  return any;
}

void FingerJoints::setForce(std::size_t i, const Vec3& f_W) { assign(feedback_[i].f1, f_W); }

Vec3 FingerJoints::force(std::size_t i) const {
  return areForces() ? active_[i].row.expected_force_W : toVec3(feedback_[i].f1);
}

}  // namespace presa::ode
