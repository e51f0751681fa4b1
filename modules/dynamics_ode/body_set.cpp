#include "modules/dynamics_ode/body_set.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/dynamics_ode/rotation.h"

namespace presa::ode {
namespace {

// limits of a plausible state: a free fall of 100 s, 1600 turns per second
constexpr double kMaxSpeed = 1e3;  // [m/s]
constexpr double kMaxSpin = 1e4;   // [rad/s]
constexpr double kMaxReach = 1e6;  // [m]
// slower rotations differ from ODE's own update by less than rounding, so the update is kept
constexpr double kMinAngle = 1e-9;  // [rad] per step

dMass massOf(const BodyInertia& inertia) {
  const Mat3& I = inertia.inertia;
  dMass mass;
  dMassSetParameters(&mass, inertia.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  return mass;
}

}  // namespace

BodySet::BodySet(const World& world, DynamicsSettings::Rotation rotation, dWorldID ode_world)
    : rotation_(rotation), bodies_(world.scene.bodies.size()) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = world.scene.bodies[i];
    const BodyInertia& inertia = world.inertias[i];
    Entry& entry = bodies_[i];
    entry.X_WB = body.X_WB;
    if (!body.fixed && inertia.mass > 0) {
      entry.p_BCm = inertia.p_BCm;
      entry.mass = inertia.mass;
      entry.inertia = inertia.inertia;
      entry.inverse_inertia = inertia.inertia.inverse();
      entry.body = dBodyCreate(ode_world);
      entry.p_WCm = dBodyGetPosition(entry.body);
      entry.v_WCm = dBodyGetLinearVel(entry.body);
      entry.w_WB = dBodyGetAngularVel(entry.body);
      entry.q_WB = dBodyGetQuaternion(entry.body);
      const dMass mass = massOf(inertia);
      dBodySetMass(entry.body, &mass);
      // ODE's gyroscopic term is inaccurate; driftRotations replaces it
      dBodySetGyroscopicMode(entry.body, rotation_ == DynamicsSettings::Rotation::kEngine ? 1 : 0);
      const Vec3 p_WCm = body.X_WB * entry.p_BCm;
      dBodySetPosition(entry.body, p_WCm.x(), p_WCm.y(), p_WCm.z());
      dBodySetQuaternion(entry.body, toOde(body.X_WB.q).data());
      dBodySetLinearVel(entry.body, body.v_WCm.x(), body.v_WCm.y(), body.v_WCm.z());
      dBodySetAngularVel(entry.body, body.w_WB.x(), body.w_WB.y(), body.w_WB.z());
      entry.constant_force_W = body.force_W;
    }
    createShapes(i, physicsShapes(body, world.meshes[i]));
  }
  for (const Joint& joint : world.scene.joints) {
    if (!joint.collide && joint.to != Joint::kWorld)
      joined_.emplace_back(std::min(joint.body, joint.to), std::max(joint.body, joint.to));
  }
  std::ranges::sort(joined_);
}

BodySet::~BodySet() {
  for (ShapeEntry& shape : shapes_) {
    dGeomDestroy(shape.geom);
    if (shape.mesh_data != nullptr) dGeomTriMeshDataDestroy(shape.mesh_data);
  }
  for (Entry& entry : bodies_) {
    if (entry.body != nullptr) dBodyDestroy(entry.body);
  }
}

Pose BodySet::poseOf(const Entry& entry, const State& state) {
  return {state.p_WCm - state.q_WB * entry.p_BCm, state.q_WB};
}

bool BodySet::sane(const Entry& entry) {
  // comparisons are written so that NaN fails
  return toVec3(entry.p_WCm).squaredNorm() < kMaxReach * kMaxReach &&
         toVec3(entry.v_WCm).squaredNorm() < kMaxSpeed * kMaxSpeed &&
         toVec3(entry.w_WB).squaredNorm() < kMaxSpin * kMaxSpin &&
         std::abs(toQuat(entry.q_WB).squaredNorm() - 1) < 2e-6;
}

BodyInertiaState BodySet::inertiaState(std::size_t i) const {
  const Entry& entry = bodies_[i];
  const State state = read(entry);
  const Mat3 R_WB = state.q_WB.toRotationMatrix();
  return {poseOf(entry, state), state.p_WCm, 1 / entry.mass, R_WB * entry.inverse_inertia * R_WB.transpose()};
}

bool BodySet::anyAwake() const noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (awake(i)) return true;
  }
  return false;
}

Pose BodySet::poseOf(std::size_t shape) const {
  dQuaternion q;
  dGeomGetQuaternion(geom(shape), q);
  return {toVec3(dGeomGetPosition(geom(shape))), toQuat(q)};
}

namespace {

bool within(const dReal* a, const dReal* b, double distance) {
  for (int low = 0; low < 6; low += 2) {
    if (a[low] - distance > b[low + 1] || b[low] - distance > a[low + 1]) return false;
  }
  return true;
}

}  // namespace

bool BodySet::shapesAreNear(std::size_t a, std::size_t b, double distance) const {
  dReal box_a[6], box_b[6];
  dGeomGetAABB(geom(a), box_a);
  dGeomGetAABB(geom(b), box_b);
  return within(box_a, box_b, distance);
}

BodySet::Bounds BodySet::bounds(std::size_t i) const {
  Bounds bounds;
  dGeomGetAABB(geom(shapes(i).first), bounds.side);
  for (std::size_t k = 1; k < shapes(i).count; ++k) {
    dReal box[6];
    dGeomGetAABB(geom(shapes(i).first + k), box);
    for (int low = 0; low < 6; low += 2) {
      bounds.side[low] = std::min(bounds.side[low], box[low]);
      bounds.side[low + 1] = std::max(bounds.side[low + 1], box[low + 1]);
    }
  }
  return bounds;
}

bool BodySet::areNear(std::size_t i, std::size_t j, double distance) const {
  if (shapes(i).count == 0 || shapes(j).count == 0) return false;
  return within(bounds(i).side, bounds(j).side, distance);
}

Vec3 BodySet::velocityAt(std::size_t i, const Vec3& p_W) const {
  if (!moves(i)) return Vec3::Zero();
  const Entry& entry = bodies_[i];
  const Vec3 w_WB = toVec3(entry.w_WB);
  return toVec3(entry.v_WCm) + w_WB.cross(p_W - entry.begin.p_WCm);
}

Vec3 BodySet::pathVelocityAt(std::size_t i, const Vec3& p_W) const {
  if (!isHeld(i)) return velocityAt(i, p_W);
  const Motion motion = read(bodies_[i]);
  return motion.v_WCm + motion.w_WB.cross(p_W - motion.p_WCm);
}

double BodySet::reach(std::size_t i, double h) const {
  if (!moves(i) && !isHeld(i)) return 0;
  const Entry& entry = bodies_[i];
  return h * (toVec3(entry.v_WCm).norm() + toVec3(entry.w_WB).norm() * entry.rim);
}

void BodySet::setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB) {
  if (moves(i)) setVelocity(bodies_[i], v_WB, w_WB);
}

void BodySet::setVelocity(const Entry& entry, const Vec3& v_WB, const Vec3& w_WB) {
  const Vec3 v_WCm = v_WB + w_WB.cross(toQuat(entry.q_WB) * entry.p_BCm);
  dBodySetLinearVel(entry.body, v_WCm.x(), v_WCm.y(), v_WCm.z());
  dBodySetAngularVel(entry.body, w_WB.x(), w_WB.y(), w_WB.z());
}

void BodySet::nudge(std::size_t i, double speed) {
  const Entry& entry = bodies_[i];
  const Vec3 oblique = speed * Vec3(0.62, -0.41, 0.67);
  const Vec3 v = toVec3(entry.v_WCm) + oblique;
  const Vec3 w = toVec3(entry.w_WB) + oblique.reverse() / std::max(entry.extent, 1e-6);
  dBodySetLinearVel(entry.body, v.x(), v.y(), v.z());
  dBodySetAngularVel(entry.body, w.x(), w.y(), w.z());
}

void BodySet::sleep(std::size_t i) {
  Entry& entry = bodies_[i];
  enable(i, false);
  entry.asleep = true;
  dBodySetLinearVel(entry.body, 0, 0, 0);
  dBodySetAngularVel(entry.body, 0, 0, 0);
}

void BodySet::pause(std::size_t i) {
  enable(i, false);
  bodies_[i].asleep = bodies_[i].paused = true;
}

void BodySet::wake(std::size_t i) {
  bodies_[i].asleep = bodies_[i].paused = false;
  bodies_[i].begin = read(bodies_[i]);
  enable(i, true);
}

void BodySet::enable(std::size_t i, bool on) {
  Entry& entry = bodies_[i];
  if (entry.enabled == on) return;
  entry.enabled = on;
  on ? dBodyEnable(entry.body) : dBodyDisable(entry.body);
}

void BodySet::setMotion(std::size_t i, const Motion& motion) {
  Entry& entry = bodies_[i];
  dBodySetPosition(entry.body, motion.p_WCm.x(), motion.p_WCm.y(), motion.p_WCm.z());
  dBodySetQuaternion(entry.body, toOde(motion.q_WB).data());
  dBodySetLinearVel(entry.body, motion.v_WCm.x(), motion.v_WCm.y(), motion.v_WCm.z());
  dBodySetAngularVel(entry.body, motion.w_WB.x(), motion.w_WB.y(), motion.w_WB.z());
  entry.rotated = true;
}

// The kinetic energy stays, whatever the moments of inertia.
void BodySet::stopAt(std::size_t i, const Vec3& p_WCm, const Quat& q_WB) {
  const Entry& entry = bodies_[i];
  const State end = read(entry);
  const Vec3 w_WB = q_WB * (end.q_WB.conjugate() * end.w_WB);
  dBodySetPosition(entry.body, p_WCm.x(), p_WCm.y(), p_WCm.z());
  dBodySetQuaternion(entry.body, toOde(q_WB).data());
  dBodySetAngularVel(entry.body, w_WB.x(), w_WB.y(), w_WB.z());
}

BodySet::Load BodySet::load(std::size_t i, const Vec3& gravity_W) const {
  const Entry& entry = bodies_[i];
  Load load{entry.mass, entry.inertia, entry.inverse_inertia, entry.force_W, entry.torque_W};
  if (entry.added_mass > 0 || entry.added_inertia > 0) {
    load.mass += entry.added_mass;
    load.inertia.diagonal().array() += entry.added_inertia;
    load.inverse_inertia = load.inertia.inverse();
  }
  if (!(entry.added_mass > 0)) load.force_W += load.mass * gravity_W;  // else the gravity is among the forces
  return load;
}

double BodySet::energyGain(std::size_t i, const Vec3& gravity_W) const {
  const Entry& entry = bodies_[i];
  const auto energy = [&](const State& state) {
    const Vec3 w_B = state.q_WB.conjugate() * state.w_WB;
    return entry.mass * state.v_WCm.squaredNorm() / 2 + w_B.dot(entry.inertia * w_B) / 2;
  };
  const State end = read(entry);
  return energy(end) - energy(entry.begin) - entry.mass * gravity_W.dot(end.p_WCm - entry.begin.p_WCm);
}

double BodySet::externalWork(std::size_t i) const {
  const Entry& entry = bodies_[i];
  if (entry.force_W.isZero(0) && entry.torque_W.isZero(0)) return 0;
  const State end = read(entry);
  const Eigen::AngleAxisd turn(end.q_WB * entry.begin.q_WB.conjugate());
  return entry.force_W.dot(end.p_WCm - entry.begin.p_WCm) + entry.torque_W.dot(turn.angle() * turn.axis());
}

Vec3 BodySet::movedSinceBegin(std::size_t i, const Vec3& p_WP) const {
  const Entry& entry = bodies_[i];
  const State end = read(entry);
  return end.p_WCm + end.q_WB * (entry.begin.q_WB.conjugate() * (p_WP - entry.begin.p_WCm)) - p_WP;
}

void BodySet::resetForces() {
  for (Entry& entry : bodies_) {
    entry.force_W = entry.constant_force_W;
    entry.torque_W.setZero();
  }
}

void BodySet::addForce(std::size_t i, const Vec3& f_W, const Vec3& p_WP) {
  Entry& entry = bodies_[i];
  entry.force_W += f_W;
  entry.torque_W += (p_WP - toVec3(entry.p_WCm)).cross(f_W);
}

void BodySet::addForceAndTorque(std::size_t i, const Vec3& f_W, const Vec3& torque_W) {
  Entry& entry = bodies_[i];
  entry.force_W += f_W;
  entry.torque_W += torque_W - (toQuat(entry.q_WB) * entry.p_BCm).cross(f_W);
}

void BodySet::addAtCentre(std::size_t i, const Vec3& f_W, const Vec3& torque_W) {
  bodies_[i].force_W += f_W;
  bodies_[i].torque_W += torque_W;
}

void BodySet::setAddedInertia(std::size_t i, double mass, double inertia) {
  Entry& entry = bodies_[i];
  if (entry.added_mass == mass && entry.added_inertia == inertia) return;
  entry.added_mass = mass;
  entry.added_inertia = inertia;
  const dMass sum = massOf({entry.mass + mass, Vec3::Zero(), entry.inertia + inertia * Mat3(Mat3::Identity())});
  dBodySetMass(entry.body, &sum);
  // m g would drown in the rounding of a gravity that acts on a large added mass
  dBodySetGravityMode(entry.body, mass > 0 ? 0 : 1);
}

void BodySet::applyForces() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Entry& entry = bodies_[i];
    if (!awake(i) || !entry.enabled) continue;
    dBodySetForce(entry.body, entry.force_W.x(), entry.force_W.y(), entry.force_W.z());
    dBodySetTorque(entry.body, entry.torque_W.x(), entry.torque_W.y(), entry.torque_W.z());
  }
}

void BodySet::beginStep() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (awake(i)) bodies_[i].begin = read(bodies_[i]);
  }
}

void BodySet::restore(std::size_t i) {
  const Entry& entry = bodies_[i];
  const State& state = entry.begin;
  dBodySetPosition(entry.body, state.p_WCm.x(), state.p_WCm.y(), state.p_WCm.z());
  dBodySetQuaternion(entry.body, toOde(state.q_WB).data());
  dBodySetLinearVel(entry.body, state.v_WCm.x(), state.v_WCm.y(), state.v_WCm.z());
  dBodySetAngularVel(entry.body, state.w_WB.x(), state.w_WB.y(), state.w_WB.z());
}

void BodySet::rotate(const Entry& entry, Quat& q_WB, Vec3& w_WB, double h) const {
  switch (rotation_) {
    case DynamicsSettings::Rotation::kEuler:
      return eulerRotation(q_WB, w_WB, entry.inertia, entry.inverse_inertia, h);
    case DynamicsSettings::Rotation::kMatrix:
      return matrixRotation(q_WB, w_WB, h);
    default:
      return driftRotation(q_WB, w_WB, entry.inertia, entry.inverse_inertia, h);
  }
}

void BodySet::driftRotations(double h) {
  if (rotation_ == DynamicsSettings::Rotation::kEngine || rotation_ == DynamicsSettings::Rotation::kNone) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Entry& entry = bodies_[i];
    if (std::exchange(entry.rotated, false) || !awake(i)) continue;
    Vec3 w_WB = toVec3(entry.w_WB);
    const double angle = w_WB.norm() * h;
    if (!(angle > kMinAngle && angle < kMaxSpin)) continue;
    Quat q_WB = entry.begin.q_WB;
    rotate(entry, q_WB, w_WB, h);
    dBodySetQuaternion(entry.body, toOde(q_WB).data());
    dBodySetAngularVel(entry.body, w_WB.x(), w_WB.y(), w_WB.z());
  }
}

void BodySet::makeStill(Entry& entry) {
  dBodySetLinearVel(entry.body, 0, 0, 0);
  dBodySetAngularVel(entry.body, 0, 0, 0);
  dBodyDisable(entry.body);
  entry.enabled = false;
  entry.still = true;
}

// Turns the body into an obstacle that ODE's solvers ignore until take().
void BodySet::detach(Entry& entry) {
  for (ShapeEntry& shape : shapesOf(entry)) {
    if (entry.still) break;
    dQuaternion q;
    dGeomGetOffsetQuaternion(shape.geom, q);
    shape.X_CmG = {toVec3(dGeomGetOffsetPosition(shape.geom)), toQuat(q)};
    dGeomSetBody(shape.geom, nullptr);
  }
  makeStill(entry);
}

void BodySet::setPose(const Entry& entry, const Pose& X_WCm) {
  dBodySetPosition(entry.body, X_WCm.p.x(), X_WCm.p.y(), X_WCm.p.z());
  dBodySetQuaternion(entry.body, toOde(X_WCm.q).data());
}

void BodySet::moveTo(Entry& entry, const Pose& X_WCm) {
  setPose(entry, X_WCm);
  for (const ShapeEntry& shape : shapesOf(entry)) {
    const Pose X_WG = X_WCm * shape.X_CmG;
    dGeomSetPosition(shape.geom, X_WG.p.x(), X_WG.p.y(), X_WG.p.z());
    dGeomSetQuaternion(shape.geom, toOde(X_WG.q).data());
  }
}

// Nonblocking: the geometries stay attached.
void BodySet::freeze(Entry& entry) {
  setPose(entry, {entry.begin.p_WCm, entry.begin.q_WB});
  makeStill(entry);
  entry.frozen = true;
}

void BodySet::put(std::size_t i) {
  if (bodies_[i].frozen) return;
  const Pose X_WCm = centrePose(i);
  detach(bodies_[i]);
  moveTo(bodies_[i], X_WCm);
}

void BodySet::take(std::size_t i) {
  Entry& entry = bodies_[i];
  entry.still = false;
  for (const ShapeEntry& shape : shapesOf(entry)) {
    dGeomSetBody(shape.geom, entry.body);
    dGeomSetOffsetPosition(shape.geom, shape.X_CmG.p.x(), shape.X_CmG.p.y(), shape.X_CmG.p.z());
    dGeomSetOffsetQuaternion(shape.geom, toOde(shape.X_CmG.q).data());
  }
  entry.begin = read(entry);
  enable(i, true);
}

void BodySet::place(std::size_t i, const Pose& X_WB) { moveTo(bodies_[i], centreOf(i, X_WB)); }

void BodySet::hold(std::size_t i, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB) {
  Entry& entry = bodies_[i];
  if (moves(i)) {
    enable(i, false);
    entry.still = entry.held = true;
  }
  setPose(entry, centreOf(i, X_WB));
  setVelocity(entry, v_WB, w_WB);
}

void BodySet::release(std::size_t i, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB) {
  Entry& entry = bodies_[i];
  setPose(entry, centreOf(i, X_WB));
  setVelocity(entry, v_WB, w_WB);
  entry.still = entry.held = false;
  entry.begin = read(entry);
  enable(i, true);
}

std::size_t BodySet::freezeBroken() {
  std::size_t count = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!awake(i) || sane(bodies_[i])) continue;
    freeze(bodies_[i]);
    ++count;
  }
  return count;
}

void BodySet::freezeAll() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (moves(i)) freeze(bodies_[i]);
  }
}

bool BodySet::anyHeld() const noexcept {
  return std::any_of(bodies_.begin(), bodies_.end(), [](const Entry& entry) { return entry.held; });
}

BodyMotion BodySet::now(std::size_t i) const {
  const Entry& entry = bodies_[i];
  const State state = read(entry);
  BodyMotion motion;
  motion.X_WB_begin = motion.X_WB_end = poseOf(entry, state);
  motion.v_WB = state.v_WCm - state.w_WB.cross(state.q_WB * entry.p_BCm);
  motion.w_WB = state.w_WB;
  return motion;
}

void BodySet::write(ObjectState& out) {
  out.bodies.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Entry& entry = bodies_[i];
    BodyMotion motion;
    if (awake(i) || isPut(i) || isHeld(i)) {
      motion = now(i);
      motion.X_WB_begin = std::exchange(entry.X_WB, motion.X_WB_end);
    } else {
      motion.X_WB_begin = motion.X_WB_end = entry.X_WB;
    }
    motion.asleep = entry.asleep && !entry.paused;
    out.bodies[i] = motion;
  }
}

}  // namespace presa::ode
