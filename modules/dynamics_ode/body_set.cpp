#include "modules/dynamics_ode/body_set.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "modules/dynamics_ode/ode_types.h"
#include "modules/dynamics_ode/rotation.h"

namespace presa::ode {
namespace {

// beyond these a state is a numerical accident: a free fall of 100 s, 1600 turns per second
constexpr double kMaxSpeed = 1e3;  // [m/s]
constexpr double kMaxSpin = 1e4;   // [rad/s]
constexpr double kMaxReach = 1e6;  // [m]
// a body this slow turns by less than rounding matters; ODE's own update is kept
constexpr double kMinAngle = 1e-9;  // [rad] per step

dMass massOf(const BodyInertia& inertia) {
  const Mat3& I = inertia.inertia;
  dMass mass;
  dMassSetParameters(&mass, inertia.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  return mass;
}

}  // namespace

BodySet::BodySet(const World& world, dWorldID ode_world, dSpaceID space) : bodies_(world.scene.bodies.size()) {
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
      const dMass mass = massOf(inertia);
      dBodySetMass(entry.body, &mass);
      dBodySetGyroscopicMode(entry.body, 0);  // wrong in ODE; driftRotations does it
      const Vec3 p_WCm = body.X_WB * entry.p_BCm;
      dBodySetPosition(entry.body, p_WCm.x(), p_WCm.y(), p_WCm.z());
      dBodySetQuaternion(entry.body, toOde(body.X_WB.q).data());
    }
    if (body.physics) createGeom(entry, *body.physics, world.meshes[i].physics.get(), space);
    if (entry.geom != nullptr) dGeomSetData(entry.geom, reinterpret_cast<void*>(i));
  }
}

BodySet::~BodySet() {
  for (Entry& entry : bodies_) {
    if (entry.geom != nullptr) dGeomDestroy(entry.geom);
    if (entry.mesh_data != nullptr) dGeomTriMeshDataDestroy(entry.mesh_data);
    if (entry.body != nullptr) dBodyDestroy(entry.body);
  }
}

void BodySet::createGeom(Entry& entry, const Geometry& geometry, const TriMesh* mesh, dSpaceID space) {
  struct Create {
    Entry& entry;
    const TriMesh* mesh;
    dSpaceID space;
    dGeomID operator()(const Box& box) { return dCreateBox(space, box.size.x(), box.size.y(), box.size.z()); }
    dGeomID operator()(const Sphere& sphere) { return dCreateSphere(space, sphere.radius); }
    dGeomID operator()(const Cylinder& cylinder) { return dCreateCylinder(space, cylinder.radius, cylinder.length); }
    dGeomID operator()(const Capsule& capsule) { return dCreateCapsule(space, capsule.radius, capsule.length); }
    dGeomID operator()(const MeshRef&) {
      if (mesh == nullptr || mesh->triangles.empty()) return nullptr;
      for (const Vec3& v : mesh->vertices) entry.vertices.insert(entry.vertices.end(), {v.x(), v.y(), v.z()});
      for (const TriMesh::Triangle& t : mesh->triangles) {
        for (const std::int32_t index : t) entry.indices.push_back(static_cast<dTriIndex>(index));
      }
      entry.mesh_data = dGeomTriMeshDataCreate();
      dGeomTriMeshDataBuildDouble(entry.mesh_data, entry.vertices.data(), 3 * sizeof(double),
                                  static_cast<int>(mesh->vertices.size()), entry.indices.data(),
                                  static_cast<int>(entry.indices.size()), 3 * sizeof(dTriIndex));
      return dCreateTriMesh(space, entry.mesh_data, nullptr, nullptr, nullptr);
    }
  };
  entry.geom = std::visit(Create{entry, mesh, space}, geometry.shape);
  if (entry.geom == nullptr) return;
  if (entry.body != nullptr) {
    dGeomSetBody(entry.geom, entry.body);
    const Vec3 p_CmG = geometry.X_BG.p - entry.p_BCm;
    dGeomSetOffsetPosition(entry.geom, p_CmG.x(), p_CmG.y(), p_CmG.z());
    dGeomSetOffsetQuaternion(entry.geom, toOde(geometry.X_BG.q).data());
  } else {
    const Pose X_WG = entry.X_WB * geometry.X_BG;
    dGeomSetPosition(entry.geom, X_WG.p.x(), X_WG.p.y(), X_WG.p.z());
    dGeomSetQuaternion(entry.geom, toOde(X_WG.q).data());
  }
  dReal bounds[6];
  dGeomGetAABB(entry.geom, bounds);
  entry.extent = 0.5 * Vec3(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]).norm();
}

BodySet::State BodySet::read(const Entry& entry) {
  return {toVec3(dBodyGetPosition(entry.body)), toVec3(dBodyGetLinearVel(entry.body)),
          toVec3(dBodyGetAngularVel(entry.body)), toQuat(dBodyGetQuaternion(entry.body))};
}

Pose BodySet::poseOf(const Entry& entry, const State& state) {
  return {state.p_WCm - state.q_WB * entry.p_BCm, state.q_WB};
}

bool BodySet::sane(const State& state) {
  // written so that NaN fails
  return state.p_WCm.norm() < kMaxReach && state.v_WCm.norm() < kMaxSpeed && state.w_WB.norm() < kMaxSpin &&
         std::abs(state.q_WB.norm() - 1) < 1e-6;
}

BodyInertiaState BodySet::inertiaState(std::size_t i) const {
  const Entry& entry = bodies_[i];
  const State state = read(entry);
  const Mat3 R_WB = state.q_WB.toRotationMatrix();
  return {poseOf(entry, state), state.p_WCm, 1 / entry.mass, R_WB * entry.inverse_inertia * R_WB.transpose()};
}

Vec3 BodySet::centreVelocity(std::size_t i) const {
  return moves(i) ? toVec3(dBodyGetLinearVel(bodies_[i].body)) : Vec3(Vec3::Zero());
}

Vec3 BodySet::angularVelocity(std::size_t i) const {
  return moves(i) ? toVec3(dBodyGetAngularVel(bodies_[i].body)) : Vec3(Vec3::Zero());
}

void BodySet::setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB) {
  if (!moves(i)) return;
  const Entry& entry = bodies_[i];
  const Vec3 v_WCm = v_WB + w_WB.cross(toQuat(dBodyGetQuaternion(entry.body)) * entry.p_BCm);
  dBodySetLinearVel(entry.body, v_WCm.x(), v_WCm.y(), v_WCm.z());
  dBodySetAngularVel(entry.body, w_WB.x(), w_WB.y(), w_WB.z());
}

void BodySet::beginStep() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (moves(i)) bodies_[i].begin = read(bodies_[i]);
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

void BodySet::driftRotations(double h) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!moves(i)) continue;
    const Entry& entry = bodies_[i];
    Vec3 w_WB = toVec3(dBodyGetAngularVel(entry.body));
    const double angle = w_WB.norm() * h;
    if (!(angle > kMinAngle && angle < kMaxSpin)) continue;
    Quat q_WB = entry.begin.q_WB;
    driftRotation(q_WB, w_WB, entry.inertia, entry.inverse_inertia, h);
    dBodySetQuaternion(entry.body, toOde(q_WB).data());
    dBodySetAngularVel(entry.body, w_WB.x(), w_WB.y(), w_WB.z());
  }
}

void BodySet::freeze(Entry& entry) {
  // as a fixed obstacle, so that ODE never sees the broken body again
  const Pose X_WCm{entry.begin.p_WCm, entry.begin.q_WB};
  if (entry.geom != nullptr) {
    const Pose X_CmG{toVec3(dGeomGetOffsetPosition(entry.geom)), [&] {
                       dQuaternion q;
                       dGeomGetOffsetQuaternion(entry.geom, q);
                       return toQuat(q);
                     }()};
    const Pose X_WG = X_WCm * X_CmG;
    dGeomSetBody(entry.geom, nullptr);
    dGeomSetPosition(entry.geom, X_WG.p.x(), X_WG.p.y(), X_WG.p.z());
    dGeomSetQuaternion(entry.geom, toOde(X_WG.q).data());
  }
  dBodySetPosition(entry.body, X_WCm.p.x(), X_WCm.p.y(), X_WCm.p.z());
  dBodySetQuaternion(entry.body, toOde(X_WCm.q).data());
  dBodySetLinearVel(entry.body, 0, 0, 0);
  dBodySetAngularVel(entry.body, 0, 0, 0);
  dBodyDisable(entry.body);
  entry.frozen = true;
}

std::size_t BodySet::freezeBroken() {
  std::size_t count = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!moves(i) || sane(read(bodies_[i]))) continue;
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

void BodySet::write(ObjectState& out) {
  out.count = static_cast<std::int32_t>(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Entry& entry = bodies_[i];
    BodyMotion& motion = out.bodies[i];
    motion.X_WB_begin = entry.X_WB;
    motion.v_WB.setZero();
    motion.w_WB.setZero();
    motion.asleep = false;
    if (moves(i)) {
      const State state = read(entry);
      entry.X_WB = poseOf(entry, state);
      motion.v_WB = state.v_WCm - state.w_WB.cross(state.q_WB * entry.p_BCm);
      motion.w_WB = state.w_WB;
    }
    motion.X_WB_end = entry.X_WB;
  }
}

}  // namespace presa::ode
