#include "tests/modules/haptics_proxy/surface/support/finger_rig.h"

#include <cmath>

#include "modules/collision_fcl/collision_module.h"
#include "modules/haptics_proxy/haptics_proxy.h"

namespace presa::test {
namespace {

constexpr double kPeriod = 1e-3;

/// The hierarchy over a mesh, cached for consecutive worlds with the same mesh.
std::shared_ptr<const MeshTree> treeOf(const std::shared_ptr<const TriMesh>& mesh) {
  thread_local std::shared_ptr<const MeshTree> last;
  if (!last || &last->mesh() != mesh.get()) {
    last.reset();
    last = std::make_shared<const MeshTree>(mesh);
  }
  return last;
}

}  // namespace

World worldOf(std::shared_ptr<const TriMesh> mesh, const Touch& touch) {
  World world;
  world.scene.rates.collision = touch.collision_hz;
  world.scene.collision = touch.collision;
  world.scene.materials.resize(1);
  Material& material = world.scene.materials[0];
  material.stiffness = touch.stiffness;
  material.friction_static = touch.friction;
  material.friction_dynamic = 0.8 * touch.friction;
  Body body;
  body.name = "body";
  body.fixed = touch.fixed;
  body.haptic = Geometry{MeshRef{}, {}, {}, touch.smooth};
  world.scene.bodies = {body};
  world.scene.devices.resize(1);
  world.scene.devices[0].fingertip_radius = touch.radius;
  world.meshes.resize(1);
  world.meshes[0].haptic = std::move(mesh);
  world.meshes[0].haptic_tree = treeOf(world.meshes[0].haptic);
  world.inertias.resize(1);
  return world;
}

template <class T>
struct FingerRig::Source final : Module {
  explicit Source(const char* port) : Module(std::string("source_of_") + port, RateGroup::kHaptic), out(*this, port) {}
  void step(const Tick&) noexcept override {}
  Out<T> out;
};

struct FingerRig::Sink final : Module {
  Sink() : Module("sink", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {}
  In<ContactExchange> contact{*this, "contact_exchange"};
};

FingerRig::FingerRig(std::shared_ptr<const TriMesh> mesh, const Touch& touch)
    : touch_(touch), world_(std::make_shared<const World>(worldOf(std::move(mesh), touch))) {
  GraphBuilder builder;
  device_ = &builder.add(std::make_unique<Source<DeviceState>>("device_state"));
  device_->out.value = DeviceState(1);
  objects_ = &builder.add(std::make_unique<Source<ObjectState>>("object_state"));
  objects_->out.value.bodies.resize(1);
  builder.add(std::make_unique<HapticsProxy>(world_, RunOptions{}));
  builder.add(std::make_unique<CollisionModule>(world_));
  sink_ = &builder.add(std::make_unique<Sink>());
  builder.connectByName();
  graph_ = builder.build();
  for (const RateGroup group : {RateGroup::kCollision, RateGroup::kHaptic}) graph_.start(group);
}

FingerRig::~FingerRig() = default;

double FingerRig::time() const { return static_cast<double>(index_) * kPeriod; }
const ContactExchange& FingerRig::all() const { return sink_->contact.value(); }

const FingerContact& FingerRig::tick(const Vec3& p_WH) {
  const auto ticks_per_query = static_cast<std::uint64_t>(std::lround(1 / (kPeriod * touch_.collision_hz)));
  const double time = FingerRig::time();
  if (index_ % ticks_per_query == 0) {
    graph_.step(RateGroup::kCollision,
                {index_ / ticks_per_query, time, static_cast<double>(ticks_per_query) * kPeriod});
  }
  device_->out.value.time = time;
  const Vec3 v_WH = index_ == 0 ? Vec3(Vec3::Zero()) : Vec3((p_WH - last_) / kPeriod);
  device_->out.value.fingers[0] = {p_WH, v_WH, -1, true};
  last_ = p_WH;
  graph_.step(RateGroup::kHaptic, {index_++, time, kPeriod});
  return sink_->contact->fingers[0];
}

const FingerContact& FingerRig::place(const Vec3& p_WH) {
  last_ = p_WH;  // no velocity
  tick(p_WH);
  graph_.step(RateGroup::kCollision, {index_, time(), 1 / touch_.collision_hz});
  return tick(p_WH);
}

void FingerRig::moveBody(const Pose& X_WB_begin, const Pose& X_WB_end, const Vec3& v_WB) {
  ObjectState& objects = objects_->out.value;
  objects.time_begin = time();
  objects.time_end = time() + 5 * kPeriod;
  objects.bodies[0].X_WB_begin = X_WB_begin;
  objects.bodies[0].X_WB_end = X_WB_end;
  objects.bodies[0].v_WB = v_WB;
}

}  // namespace presa::test
