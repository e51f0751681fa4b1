#include "framework/bus/rig_frames.h"

#include <algorithm>

namespace presa::bus {

std::vector<RigFrame> rigFrames(const Rig& rig) {
  std::vector<RigFrame> frames;
  for (const Frame& frame : rig.frames) frames.push_back({frame.name, frame.parent, frame.zoom.has_value()});
  return frames;
}

std::vector<std::string> placesOf(const World& world) {
  std::vector<std::string> places;
  if (world.rig.frames.empty()) return places;
  for (const DeviceRole& role : world.scene.devices) {
    const auto device = std::ranges::find(world.rig.devices, role.role, &DeviceBinding::role);
    places.push_back(device == world.rig.devices.end() ? kWorldFrame : device->frame);
  }
  return places;
}

Rig rigOf(const RunInfo& run, const Scene& scene) {
  Rig rig;
  for (const RigFrame& sent : run.frames) {
    Frame& frame = rig.frames.emplace_back();
    frame.name = sent.name;
    frame.parent = sent.parent;
    if (sent.zooms) frame.zoom = Frame::Zoom{};
  }
  for (std::size_t f = 0; f < scene.devices.size() && f < run.places.size(); ++f) {
    DeviceBinding& device = rig.devices.emplace_back();
    device.role = scene.devices[f].role;
    device.frame = run.places[f];
  }
  return rig;
}

}  // namespace presa::bus
