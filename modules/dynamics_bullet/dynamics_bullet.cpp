#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "framework/core/graph/port.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/physics_shapes.h"
#include "framework/session/module_plugin.h"

namespace presa::bullet {
namespace {

btVector3 toBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
btTransform toBullet(const Pose& X) {
  return btTransform(btQuaternion(X.q.x(), X.q.y(), X.q.z(), X.q.w()), toBullet(X.p));
}
Vec3 fromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
Pose fromBullet(const btTransform& X) {
  const btQuaternion q = X.getRotation();
  return {fromBullet(X.getOrigin()), Quat(q.w(), q.x(), q.y(), q.z())};
}

std::unique_ptr<btCollisionShape> shapeOf(const Shape& shape, const Body& body) {
  if (const auto* box = std::get_if<Box>(&shape)) return std::make_unique<btBoxShape>(toBullet(box->size / 2));
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return std::make_unique<btSphereShape>(sphere->radius);
  if (const auto* rod = std::get_if<Cylinder>(&shape))
    return std::make_unique<btCylinderShapeZ>(btVector3(rod->radius, rod->radius, rod->length / 2));
  if (const auto* rod = std::get_if<Capsule>(&shape))
    return std::make_unique<btCapsuleShapeZ>(rod->radius, rod->length);
  Diagnostics diagnostics;
  diagnostics.error(582, body.physics->where,
                    "body '" + body.name + "': dynamics_bullet has no mesh as physics geometry",
                    "use a box, sphere, cylinder or capsule, or engine=\"ode\"");
  throw InputError(diagnostics);
}

/// The free bodies of a scene, stepped by Bullet. Thread: dynamics.
class DynamicsBullet final : public Module {
 public:
  explicit DynamicsBullet(std::shared_ptr<const World> world)
      : Module("dynamics_bullet", RateGroup::kDynamics), scene_world_(std::move(world)) {
    objects_.value.bodies.resize(scene_world_->scene.bodies.size());
    const DynamicsSettings& settings = scene_world_->scene.dynamics;
    substeps_ = static_cast<int>(std::max<std::size_t>(1, settings.substeps));
    bullet_.setGravity(toBullet(scene_world_->scene.gravity));
    if (settings.iterations > 0) bullet_.getSolverInfo().m_numIterations = static_cast<int>(settings.iterations);
    for (std::size_t i = 0; i < scene_world_->scene.bodies.size(); ++i) add(i);
  }
  ~DynamicsBullet() override {
    for (Entry& entry : bodies_) {
      if (entry.body) bullet_.removeRigidBody(entry.body.get());
    }
  }

  void start() override {
    write(objects_.value);
    write(objects_.value);
    objects_.value.time_begin = objects_.value.time_end = 0;
  }

  void step(const Tick& tick) noexcept override {
    for (const Entry& entry : bodies_) {
      if (entry.body && !entry.force.isZero()) entry.body->applyCentralForce(entry.force);
    }
    bullet_.stepSimulation(tick.period, substeps_, tick.period / substeps_);
    write(objects_.value);
    objects_.value.time_begin = tick.time;
    objects_.value.time_end = tick.time + tick.period;
  }

  std::vector<std::string> stages() const override {
    return {"collide and solve by Bullet (sequential impulses), " + std::to_string(substeps_) + " step(s) a period"};
  }

 private:
  struct Entry {
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::unique_ptr<btCompoundShape> compound;
    std::unique_ptr<btRigidBody> body;
    btVector3 force{0, 0, 0};
  };

  /// Bullet requires the centre of mass at the origin and principal axes of inertia. The body frame is used as such; a
  /// scene in which it does not qualify is refused (E583).
  void add(std::size_t i) {
    const Body& body = scene_world_->scene.bodies[i];
    const BodyInertia& inertia = scene_world_->inertias[i];
    bodies_.emplace_back();
    Entry& entry = bodies_.back();
    if (!body.physics) return;
    if (!body.fixed && (inertia.p_BCm.norm() > 1e-9 || !inertia.inertia.isDiagonal(1e-9))) {
      Diagnostics diagnostics;
      diagnostics.error(
          583, body.where,
          "body '" + body.name + "': dynamics_bullet needs its frame at the centre of mass, along the principal axes");
      throw InputError(diagnostics);
    }
    entry.compound = std::make_unique<btCompoundShape>();
    bool centred = false;
    for (const PhysicsShape& one : physicsShapes(body, scene_world_->meshes[i])) {
      entry.shapes.push_back(shapeOf(*one.shape, body));
      entry.compound->addChildShape(toBullet(one.X_BG), entry.shapes.back().get());
      centred = one.X_BG.p.isZero() && one.X_BG.q.isApprox(Quat::Identity());
    }
    centred = centred && entry.shapes.size() == 1;
    btCollisionShape* shape = centred ? entry.shapes.front().get() : entry.compound.get();
    btRigidBody::btRigidBodyConstructionInfo info(inertia.mass, nullptr, shape,
                                                  toBullet(Vec3(inertia.inertia.diagonal())));
    info.m_startWorldTransform = toBullet(body.X_WB);
    info.m_friction = std::sqrt(scene_world_->scene.materialOf(body).friction_dynamic);
    entry.body = std::make_unique<btRigidBody>(info);
    entry.body->setLinearVelocity(toBullet(body.v_WCm));
    entry.body->setAngularVelocity(toBullet(body.w_WB));
    entry.force = toBullet(body.force_W);
    if (!scene_world_->scene.dynamics.sleeping) entry.body->setActivationState(DISABLE_DEACTIVATION);
    bullet_.addRigidBody(entry.body.get());
  }

  void write(ObjectState& out) noexcept {
    const std::vector<Body>& bodies = scene_world_->scene.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      BodyMotion& motion = out.bodies[i];
      motion.X_WB_begin = motion.X_WB_end;
      if (bodies[i].fixed || !bodies_[i].body) {
        motion.X_WB_begin = motion.X_WB_end = bodies[i].X_WB;
        continue;
      }
      const btRigidBody& body = *bodies_[i].body;
      motion.X_WB_end = fromBullet(body.getWorldTransform());
      motion.v_WB = fromBullet(body.getLinearVelocity());
      motion.w_WB = fromBullet(body.getAngularVelocity());
      motion.asleep = !body.isActive();
    }
  }

  std::shared_ptr<const World> scene_world_;
  int substeps_ = 1;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld bullet_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<Entry> bodies_;
  Out<ObjectState> objects_{*this, "object_state"};
};

const ModulePlugin kPlugin{
    .name = "dynamics_bullet",
    .create = [](std::shared_ptr<const World> world, const RunOptions&) -> std::unique_ptr<Module> {
      return std::make_unique<DynamicsBullet>(std::move(world));
    },
    .library =
        [] {
          const int version = btGetVersion();
          return "Bullet " + std::to_string(version / 100) + "." + std::to_string(version % 100);
        }};

}  // namespace
}  // namespace presa::bullet

PRESA_MODULE_PLUGIN(presa::bullet::kPlugin)
