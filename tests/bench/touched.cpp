#include "tests/bench/touched.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "framework/core/graph/graph_builder.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/device/minimum_jerk.h"
#include "framework/scene/manifest.h"
#include "modules/collision_fcl/collision_module.h"
#include "modules/haptics_proxy/haptics_proxy.h"

namespace presa::bench {
namespace {

using std::numbers::pi;

BodyMeshes hapticMesh(const std::shared_ptr<const TriMesh>& mesh) {
  BodyMeshes meshes;
  meshes.haptic = mesh;
  if (mesh) {
    static std::map<std::shared_ptr<const TriMesh>, std::shared_ptr<const MeshTree>> made;
    std::shared_ptr<const MeshTree>& tree = made[mesh];
    if (!tree) tree = std::make_shared<const MeshTree>(mesh);
    meshes.haptic_tree = tree;
  }
  return meshes;
}

// Parts of a pass before its lap: lift off, return along the path, come down, and slide until all is steady [ticks].
constexpr std::ptrdiff_t kOff = 100, kBack = 100, kDown = 200, kSteady = 200;
constexpr std::ptrdiff_t kLead = kOff + kBack + kDown + kSteady;
constexpr double kAbove = 0.03;  // [m]

}  // namespace

std::shared_ptr<const TriMesh> sphereMesh(int triangles, bool bumpy) {
  static std::map<std::pair<int, bool>, std::shared_ptr<const TriMesh>> all;
  std::shared_ptr<const TriMesh>& made = all[{triangles, bumpy}];
  if (made) return made;
  int subdivisions = 0;
  for (int count = 20; count < triangles; count *= 4) ++subdivisions;
  TriMesh mesh = makeSphere(kSphere, subdivisions);
  for (Vec3& v : mesh.vertices) {
    if (bumpy) v *= 1 + 0.01 * std::sin(300 * v.x()) * std::sin(300 * v.y()) * std::sin(300 * v.z());
  }
  buildAdjacency(mesh);
  made = std::make_shared<const TriMesh>(std::move(mesh));
  return made;
}

namespace {

std::shared_ptr<World> makeWorldOf(const std::vector<Touched>& bodies, double fingertip_radius, int fingers,
                                   const std::string& renderer) {
  auto world = std::make_shared<World>();
  world->scene.haptics.renderer = renderer;
  world->scene.haptics.proxy = findManifest(renderer)->hasProxy();
  Material material;
  material.stiffness = 1000;
  material.friction_static = 0.6;
  material.friction_dynamic = 0.4;
  world->scene.materials.push_back(material);
  for (const Touched& touched : bodies) {
    Body body;
    body.name = "body_" + std::to_string(world->scene.bodies.size());
    body.fixed = touched.fixed;
    body.X_WB.p = touched.p_WB;
    body.haptic = touched.mesh ? Geometry{MeshRef{}, {}, {}} : Geometry{Box{touched.box}, {}, {}};
    world->scene.bodies.push_back(std::move(body));
    world->meshes.push_back(hapticMesh(touched.mesh));
  }
  world->inertias.resize(bodies.size());
  for (int f = 0; f < fingers; ++f) {
    DeviceRole role;
    role.role = "finger_" + std::to_string(f);
    role.fingertip_radius = fingertip_radius;
    world->scene.devices.push_back(role);
  }
  world->tools.resize(world->scene.devices.size());
  return world;
}

}  // namespace

std::shared_ptr<const World> worldOf(const std::vector<Touched>& bodies, double fingertip_radius, int fingers,
                                     const std::string& renderer) {
  return makeWorldOf(bodies, fingertip_radius, fingers, renderer);
}

std::shared_ptr<const World> worldOfLine(const std::vector<Touched>& bodies, double radius,
                                         const std::string& renderer) {
  constexpr double kLength = 0.1;
  auto world = makeWorldOf(bodies, radius, 1, kDefaultRenderer);
  world->scene.haptics.tool_renderer = renderer;
  world->scene.devices[0].tool = Tool{Geometry{Capsule{radius, kLength}, {}, {}}, {}};
  world->tools[0] = std::make_shared<const TriMesh>(makeCapsule(radius, kLength));
  return world;
}

std::vector<Vec3> wayAround(double radius) {
  const auto at = [](double s) {
    return Vec3(std::cos(s), std::sin(s), 0.5 * std::sin(2 * s) + 0.2 * std::cos(3 * s)).normalized();
  };
  constexpr int kFine = 100'000;
  std::vector<double> length(kFine + 1, 0);
  for (std::size_t i = 0; i < kFine; ++i) {
    const double s = 2 * pi / kFine * static_cast<double>(i);
    length[i + 1] = length[i] + (at(s + 2 * pi / kFine) - at(s)).norm();
  }
  const auto ticks = static_cast<std::size_t>(10 * std::round(length.back() * radius / (kSpeed * 1e-3) / 10));
  std::vector<Vec3> way;
  std::size_t i = 0;
  for (std::size_t t = 0; t < ticks; ++t) {
    const double wanted = length.back() * static_cast<double>(t) / static_cast<double>(ticks);
    while (length[i + 1] < wanted) ++i;
    const double part = (wanted - length[i]) / (length[i + 1] - length[i]);
    way.push_back(at(2 * pi / kFine * (static_cast<double>(i) + part)));
  }
  return way;
}

Motion aroundSphere(double fingertip_radius) {
  const double radius = kSphere + fingertip_radius - kDepth;
  auto way = std::make_shared<const std::vector<Vec3>>(wayAround(radius));
  Motion motion;
  motion.lap = way->size();
  motion.p_BH = [way, radius](std::size_t finger, std::size_t tick, double height) -> Vec3 {
    return (radius + height) * (*way)[(tick + finger * way->size() / 2) % way->size()];
  };
  return motion;
}

struct Rig::Hands final : Module {
  Hands() : Module("hands", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {}
  Out<DeviceState> out{*this, "device_state"};
};

struct Rig::Bodies final : Module {
  explicit Bodies(std::size_t count) : Module("bodies", RateGroup::kDynamics) { out.value.bodies.resize(count); }
  void step(const Tick&) noexcept override {}
  Out<ObjectState> out{*this, "object_state"};
};

struct Rig::Watcher final : Module {
  Watcher() : Module("watcher", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {}
  In<ContactExchange> in{*this, "contact_exchange"};
};

namespace {

Tick tickAt(std::ptrdiff_t tick, std::ptrdiff_t divisor) {
  return {static_cast<std::uint64_t>((tick + kLead) / divisor), 1e-3 * static_cast<double>(tick + kLead),
          1e-3 * static_cast<double>(divisor)};
}

constexpr std::array kGroups{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic};

}  // namespace

Rig::Rig(std::shared_ptr<const World> world, Motion motion) : world_(std::move(world)), motion_(std::move(motion)) {
  GraphBuilder builder;
  hands_ = &builder.add(std::make_unique<Hands>());
  hands_->out.value = DeviceState(world_->scene.devices.size());
  bodies_ = &builder.add(std::make_unique<Bodies>(world_->scene.bodies.size()));
  builder.add(std::make_unique<HapticsProxy>(world_, RunOptions{}));
  builder.add(std::make_unique<CollisionModule>(world_));
  watcher_ = &builder.add(std::make_unique<Watcher>());
  builder.connectByName();
  graph_ = builder.build();
  for (std::size_t b = 0; b < world_->scene.bodies.size(); ++b) {
    BodyMotion& body = bodies_->out.value.bodies[b];
    body.X_WB_begin = body.X_WB_end = world_->scene.bodies[b].X_WB;
    body.asleep = true;
  }
  bodies_->out.value.bodies[motion_.carrier].asleep = false;
  for (const std::size_t b : motion_.swinging) bodies_->out.value.bodies[b].asleep = false;
  fillPass();
  for (const RateGroup group : kGroups) graph_.start(group);
}

Rig::~Rig() {
  for (const RateGroup group : kGroups) graph_.stop(group);
}

Pose Rig::swung(std::size_t body, std::ptrdiff_t tick) const {
  Pose X_WB = world_->scene.bodies[body].X_WB;
  const double phase = 8 * pi * static_cast<double>(tick) / static_cast<double>(motion_.lap);
  X_WB.p += 5e-3 * std::sin(phase) * Vec3(1, 2, 2) / 3;
  X_WB.q = Quat(Eigen::AngleAxisd(0.2 * std::cos(phase), Vec3(2, -1, 2) / 3)) * X_WB.q;
  return X_WB;
}

void Rig::fillPass() {
  const std::size_t fingers = world_->scene.devices.size();
  for (std::size_t f = 0; f < fingers; ++f) hands_->out.value.fingers[f].valid = true;
  const std::ptrdiff_t lap = this->lap(), sliding = kDown + kSteady;
  const bool swings = std::ranges::find(motion_.swinging, motion_.carrier) != motion_.swinging.end();
  for (std::ptrdiff_t t = -kLead; t < lap; ++t) {
    std::ptrdiff_t place = t;
    double above = 0;
    if (t < -sliding - kBack) {
      place = lap - 1;
      above = kAbove * minimumJerk(static_cast<double>(t + kLead + 1) / kOff);
    } else if (t < -sliding) {
      place = lap - 1 - (t + sliding + kBack) * (sliding - 1) / kBack;
      above = kAbove;
    } else if (t < -kSteady) {
      above = kAbove * (1 - minimumJerk(static_cast<double>(t + sliding + 1) / kDown));
    }
    const Pose X_WB = swings ? swung(motion_.carrier, t) : world_->scene.bodies[motion_.carrier].X_WB;
    for (std::size_t f = 0; f < fingers; ++f) {
      const Vec3 p_WH = X_WB * motion_.p_BH(f, static_cast<std::size_t>((place + lap) % lap), above);
      const Vec3 way = held_.size() < fingers ? Vec3::Zero() : Vec3(p_WH - held_[held_.size() - fingers].p_WH);
      // a line lies along the way, square to the radius
      const Vec3 along = way - way.dot(p_WH) / p_WH.squaredNorm() * p_WH;
      const Quat q_WH = along.norm() > 0 ? Quat(Quat::FromTwoVectors(Vec3::UnitZ(), along)) : Quat(Quat::Identity());
      held_.push_back({p_WH, way / 1e-3});
      if (world_->scene.devices[f].tool) turns_.push_back(q_WH);
    }
  }
}

void Rig::comeDown() {
  // the first pass has no contact to lift off from
  for (std::ptrdiff_t t = fresh_ ? kOff - kLead : -kLead; t < 0; ++t) {
    if (t % kDynamics == 0) moveBodies(t);
    if (t % kCollision == 0) collide(t);
    moveFingers(t);
    haptic(t);
  }
  fresh_ = false;
}

void Rig::moveBodies(std::ptrdiff_t tick) noexcept {
  const Tick now = tickAt(tick, kDynamics);
  ObjectState& objects = bodies_->out.value;
  objects.time_begin = now.time;
  objects.time_end = now.time + now.period;
  for (const std::size_t b : motion_.swinging) {
    BodyMotion& body = objects.bodies[b];
    body.X_WB_begin = swung(b, tick);
    body.X_WB_end = swung(b, tick + kDynamics);
    body.v_WB = (body.X_WB_end.p - body.X_WB_begin.p) / now.period;
    const Eigen::AngleAxisd turned(body.X_WB_end.q * body.X_WB_begin.q.conjugate());
    body.w_WB = turned.axis() * turned.angle() / now.period;
  }
  graph_.step(RateGroup::kDynamics, now);
}

void Rig::moveFingers(std::ptrdiff_t tick) noexcept {
  DeviceState& device = hands_->out.value;
  const auto fingers = static_cast<std::size_t>(device.count());
  device.time = 1e-3 * static_cast<double>(tick + kLead);
  for (std::size_t f = 0; f < fingers; ++f) {
    const Held& held = held_[static_cast<std::size_t>(tick + kLead) * fingers + f];
    device.fingers[f].p_WH = held.p_WH;
    device.fingers[f].v_WH = held.v_WH;
    if (turns_.empty()) continue;
    device.fingers[f].oriented = true;
    device.fingers[f].q_WT = turns_[static_cast<std::size_t>(tick + kLead) * fingers + f];
  }
}

void Rig::collide(std::ptrdiff_t tick) noexcept { graph_.step(RateGroup::kCollision, tickAt(tick, kCollision)); }

void Rig::haptic(std::ptrdiff_t tick) noexcept { graph_.step(RateGroup::kHaptic, tickAt(tick, 1)); }

const ContactExchange& Rig::contacts() const { return watcher_->in.value(); }

}  // namespace presa::bench
