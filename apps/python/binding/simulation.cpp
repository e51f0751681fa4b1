#include "apps/python/binding/simulation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "framework/scene/load.h"
#include "framework/session/load_world.h"

namespace presa::python {
namespace {

enum SimulationCode { kFingersMissing = 150 };

std::vector<Override> overridesOf(const std::vector<std::string>& sets) {
  std::vector<Override> overrides;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    overrides.push_back({set.substr(0, equals), equals == std::string::npos ? "" : set.substr(equals + 1)});
  }
  return overrides;
}

/// Every role must be given, and nothing but roles.
void checkRoles(const Scene& scene, const Setup& setup, Diagnostics& diagnostics) {
  std::vector<std::string> roles;
  for (const DeviceRole& device : scene.devices) {
    roles.push_back(device.role);
    if (!setup.fingers.contains(device.role))
      diagnostics.error(kFingersMissing, device.where, "finger '" + device.role + "' has no start position",
                        "fingers={...} names all fingers of the scene, or is left out: then the rig moves them");
  }
  for (const auto& [role, place] : setup.fingers) {
    if (std::ranges::find(roles, role) == roles.end())
      diagnostics.error(kFingersMissing, {scene.file, 0, 0},
                        "the scene has no finger '" + role + "'" + didYouMean(role, roles),
                        roles.empty() ? "it has none" : "its first is '" + roles.front() + "'");
  }
}

/// The rig of fingers that a program moves: a driver that needs nothing and is not made.
std::string placeholderRig(const Scene& scene) {
  std::string xml = "<rig version=\"1.0\" name=\"moved_fingers\">";
  for (const DeviceRole& device : scene.devices) xml += "<device role=\"" + device.role + "\" driver=\"pointer\"/>";
  return xml + "</rig>";
}

std::string rigOf(const Scene& scene, const Setup& setup, Diagnostics& diagnostics) {
  if (!setup.fingers.empty()) return placeholderRig(scene);
  const std::string file = setup.rig.empty() ? scene.default_rig : setup.rig;
  return file.empty() ? "" : loadRig(file, diagnostics).resolved_xml;
}

Loaded load(const Setup& setup, RunOptions options, Diagnostics& diagnostics) {
  if (setup.fingers.empty() && setup.text.empty())
    return loadWorld({setup.scene, setup.rig, setup.sets}, std::move(options), diagnostics);
  const auto overrides = overridesOf(setup.sets);
  const Scene scene = setup.text.empty() ? loadScene(setup.scene, overrides, diagnostics)
                                         : parseScene(setup.text, setup.scene, ".", overrides, diagnostics);
  if (!setup.fingers.empty() && !diagnostics.hasErrors()) checkRoles(scene, setup, diagnostics);
  if (diagnostics.hasErrors()) return {};
  const RunTexts texts{scene.resolved_xml, setup.scene, rigOf(scene, setup, diagnostics)};
  if (diagnostics.hasErrors()) return {};
  return setup.fingers.empty() ? loadWorldFromText(texts, std::move(options), diagnostics)
                               : loadWithoutDevices(texts, std::move(options), diagnostics);
}

}  // namespace

Simulation::Read Simulation::read(const Setup& setup) {
  RunOptions options;
  options.realtime = false;
  options.seed = setup.seed;
  options.duration = setup.duration > 0 ? setup.duration : setup.fingers.empty() ? 0 : Simulation::kEndless;
  options.record = setup.record;
  options.overwrite = setup.overwrite;
  options.bound_stiffness = true;  // as `presa run`
  Diagnostics diagnostics;
  Read read{load(setup, std::move(options), diagnostics), {}};
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  for (const Diagnostic& finding : diagnostics.all()) read.notes.push_back(format(finding));
  return read;
}

Simulation::Simulation(const Setup& setup) : Simulation(setup, read(setup)) {}

Simulation::Simulation(const Setup& setup, Read read) : notes_(std::move(read.notes)), snapshot_(*read.loaded.world) {
  Session::Options options;
  for (const DeviceRole& device : read.loaded.world->scene.devices) {
    const auto start = setup.fingers.find(device.role);
    if (start == setup.fingers.end()) break;
    targets_.push_back(start->second);
    auto finger = std::make_unique<MovedFinger>(Vec3(start->second.data()));
    moved_.push_back(finger.get());
    options.devices.push_back(std::move(finger));
  }
  auto tap = std::make_unique<SnapshotTap>(snapshot_);
  tap_ = tap.get();
  options.more.push_back(std::move(tap));
  run_ = std::make_unique<Run>(std::move(read.loaded), control_, std::move(options));
  const auto& said = run_->session().notes();
  notes_.insert(notes_.end(), said.begin(), said.end());
  left_ = run_->executor().rates().ticksWithin(RateGroup::kHaptic, run_->options().duration);
}

Simulation::~Simulation() {
  try {
    close();
  } catch (...) {  // a module that fails to stop: nobody is left who could be told
  }
}

bool Simulation::step(std::uint64_t ticks, const std::function<void()>& pause) {
  if (closed_) throw std::logic_error("the simulation is closed");
  if (!begun_) run_->begin();
  begun_ = true;
  if (ticks == 0 || left_ == 0) return left_ > 0;
  for (std::size_t f = 0; f < moved_.size(); ++f) moved_[f]->goTo(Vec3(targets_[f].data()), ticks);
  ticks = std::min(ticks, left_);
  for (; ticks > 1; pause()) {
    const std::uint64_t part = std::min(ticks - 1, kPauseTicks);
    run_->advance(part);
    ticks -= part;
    left_ -= part;
  }
  tap_->want(true);
  run_->advance(1);
  tap_->want(false);
  --left_;
  return left_ > 0;
}

void Simulation::close() {
  if (std::exchange(closed_, true) || !begun_) return;
  run_->finish();
}

void Simulation::press(std::size_t finger, std::uint32_t buttons) {
  if (finger >= moved_.size()) throw std::logic_error("the devices of the rig move the fingers of this simulation");
  moved_[finger]->press(buttons);
}

}  // namespace presa::python
