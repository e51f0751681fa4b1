#include "experiments/runner/definition/sample_names.h"

#include <algorithm>

namespace presa::experiment {
namespace {

constexpr std::size_t kPerRole = 13, kPerBody = 8;  // slots, as sampleNames() lists them

}  // namespace

SymbolTable sampleNames(const Scene& scene) {
  SymbolTable names({"t", "t_phase", "signal"});
  for (const DeviceRole& role : scene.devices) {
    for (const char* what : {"x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", "fn", "ft", "depth", "state"})
      names.add(role.role + "." + what);
  }
  for (const Body& body : scene.bodies) {
    if (body.fixed) continue;
    for (const char* what : {"x", "y", "z", "vx", "vy", "vz", "speed", "lift"}) names.add(body.name + "." + what);
  }
  return names;
}

SampleReader::SampleReader(const Scene& scene, const std::vector<bool>& asked) : roles_(scene.devices.size()) {
  std::size_t slot = kSignal + 1 + roles_ * kPerRole;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].fixed) continue;
    const auto first = asked.begin() + static_cast<std::ptrdiff_t>(slot);
    if (std::find(first, first + kPerBody, true) != first + kPerBody)
      bodies_.push_back({i, slot, scene.bodies[i].X_WB.p.z()});
    slot += kPerBody;
  }
}

void SampleReader::read(double time, const DeviceState& device, const ContactExchange& contact,
                        const ForceCommand& command, const ObjectState* objects,
                        std::span<double> values) const noexcept {
  std::size_t slot = kSignal + 1;
  values[kSignal] = 0;
  const auto put = [&](const Vec3& v) {
    for (int k = 0; k < 3; ++k) values[slot++] = v[k];
  };
  for (std::size_t f = 0; f < roles_; ++f) {
    const FingerContact& touch = contact.fingers[f];
    if ((device.fingers[f].buttons & 1U) != 0) values[kSignal] = 1;
    put(device.fingers[f].p_WH);
    put(device.fingers[f].v_WH);
    put(command.f_H_W[f]);
    values[slot++] = touch.normal_force;
    values[slot++] = touch.tangential_force_W.norm();
    values[slot++] = touch.mode == ContactMode::kNone ? 0 : touch.depth;
    values[slot++] = static_cast<double>(touch.mode);
  }
  for (const FreeBody& body : bodies_) {
    const Vec3 p =
        objects == nullptr ? Vec3(Vec3::Zero()) : objects->poseAt(static_cast<std::int32_t>(body.index), time).p;
    slot = body.slot;
    const Vec3 v = objects == nullptr ? Vec3(Vec3::Zero()) : objects->bodies[body.index].v_WB;
    put(p);
    put(v);
    values[slot++] = v.norm();
    values[slot++] = p.z() - body.start_z;
  }
}

}  // namespace presa::experiment
