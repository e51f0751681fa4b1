#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "framework/record/monitor/monitor.h"

namespace presa::test {

/// A table, a 0.2 kg cube with friction 0.8 / 0.6, and two fingers.
inline std::shared_ptr<World> pinchWorld() {
  auto world = std::make_shared<World>();
  Scene& scene = world->scene;
  scene.name = "pinch";
  scene.file = "pinch.xml";
  Material rubber;
  rubber.name = "rubber";
  rubber.stiffness = 1000;
  rubber.friction_static = 0.8;
  rubber.friction_dynamic = 0.6;
  scene.materials = {rubber};
  Body table, cube;
  table.name = "table";
  table.fixed = true;
  cube.name = "cube";
  cube.X_WB.p = Vec3(0, 0, 0.035);
  cube.mass = 0.2;
  scene.bodies = {table, cube};
  DeviceRole thumb, index;
  thumb.role = "thumb";
  index.role = "index";
  scene.devices = {thumb, index};
  world->rig.name = "desk";
  world->inertias.resize(2);
  world->inertias[1].mass = 0.2;
  return world;
}
inline constexpr std::int32_t kCube = 1;

/// The states of one tick, which a test changes and feeds to a monitor.
struct Feed {
  explicit Feed(double duration, double release_time = std::numeric_limits<double>::infinity(), double trace_rate = 0)
      : Feed(pinchWorld(), duration, release_time, trace_rate) {}
  Feed(std::shared_ptr<const World> shared_world, double duration,
       double release_time = std::numeric_limits<double>::infinity(), double trace_rate = 0)
      : world(std::move(shared_world)), monitor(world, duration, release_time, trace_rate) {
    objects.bodies.resize(2);
    place(Vec3(0, 0, 0.035));
  }

  void place(const Vec3& p) {
    objects.bodies[1].X_WB_begin = objects.bodies[1].X_WB_end = Pose{p, Quat::Identity()};
    ++version;
  }
  void touch(std::size_t finger, ContactMode mode, double normal_force = 1, double tangential_force = 0) {
    FingerContact& c = contact.fingers[finger];
    c.mode = mode;
    c.body = mode == ContactMode::kNone ? kNoBody : kCube;
    c.normal_force = mode == ContactMode::kNone ? 0 : normal_force;
    c.tangential_force_W = Vec3(0, 0, mode == ContactMode::kNone ? 0 : -tangential_force);
    c.f_H_W = Vec3(c.normal_force, 0, 0) + c.tangential_force_W;
  }
  void tick(bool with_objects = true) {
    const double period = 1 / world->scene.rates.haptic;
    const Tick now{index, static_cast<double>(index) * period, period};
    device.time = contact.time = command.time = now.time;
    monitor.observe({now, device, contact, command, with_objects ? &objects : nullptr, version});
    ++index;
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }

  std::shared_ptr<const World> world;
  Monitor monitor;
  DeviceState device{2};
  ContactExchange contact{2};
  ForceCommand command{2};
  ObjectState objects;
  std::uint64_t index = 0;
  std::uint64_t version = 0;
};

}  // namespace presa::test
