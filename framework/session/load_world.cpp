#include "framework/session/load_world.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "framework/input/folders.h"
#include "framework/scene/bus_settings.h"
#include "framework/scene/load.h"
#include "framework/scene/physics_shapes.h"
#include "framework/session/realtime_policy.h"
#include "framework/session/session.h"
#include "framework/session/stiffness_bound.h"

namespace presa {
namespace {

enum LoadCode { kGuideUnheard = 770, kNothingToGuide = 771 };

std::vector<Override> parseSets(const std::vector<std::string>& sets, Diagnostics& diagnostics) {
  std::vector<Override> overrides;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0) {
      diagnostics.error(123, {"--set " + set, 0, 0}, "expected PATH=VALUE, found '" + set + "'",
                        "for example --set body/cube/physics/mass=0.1");
      continue;
    }
    overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  return overrides;
}

/// Lowers stiffnesses and dampings above their stability bound as --set would, so that a recording holds the rendered
/// values. Makes the devices again if it lowers one, because a simulated hand chooses its damping by the stiffness that
/// it touches.
void boundStiffness(Loaded& loaded, Diagnostics& diagnostics) {
  const Scene& scene = loaded.world->scene;
  auto lowered = boundedHandles(loaded.devices, loaded.plan, scene, diagnostics);
  std::ranges::move(boundedMaterials(scene, stiffnessBound(loaded.devices, loaded.plan, scene), diagnostics),
                    std::back_inserter(lowered));
  std::ranges::move(boundedDampings(scene, dampingBound(loaded.devices, loaded.plan, scene), diagnostics),
                    std::back_inserter(lowered));
  if (lowered.empty()) return;
  World world = *loaded.world;
  Diagnostics known;  // the scene's own findings have been reported
  world.scene = parseScene(scene.resolved_xml, scene.file, ".", lowered, known);
  loaded.world = std::make_shared<const World>(std::move(world));
  loaded.devices = createDevices(loaded.world, loaded.options, loaded.plan, diagnostics);
}

double scriptEnd(const DeviceList& devices) {
  double end = 0;
  for (const auto& device : devices) {
    const std::vector<double> times = device->phaseTimes();
    if (!times.empty()) end = std::max(end, times.back());
  }
  return end > 0 ? end : kDefaultDuration;
}

/// Plan, options and world. The devices are missing.
Loaded finish(Scene scene, Rig rig, RunOptions options, Diagnostics& diagnostics) {
  Loaded loaded;
  std::vector<PlannedDevice> devices = bindDevices(scene, rig, diagnostics);
  const bool may_fly = options.realtime && options.flight.empty() && !options.hardware_flight.empty();
  if (may_fly && drivesHardware(devices)) options.flight = options.hardware_flight;
  loaded.plan = makePlan(scene, rig, std::move(devices), options, diagnostics);
  settleBus(scene, rig, options);
  if (options.realtime) checkCommandRate(scene, rig, loaded.plan, diagnostics);
  // meshes are read even if the scene has findings, so that the user sees all findings at once
  loaded.world = std::make_shared<const World>(buildWorld(std::move(scene), std::move(rig), diagnostics));
  loaded.options = std::move(options);
  return loaded;
}

void addDevices(Loaded& loaded, Diagnostics& diagnostics) {
  if (diagnostics.hasErrors()) return;
  loaded.devices = createDevices(loaded.world, loaded.options, loaded.plan, diagnostics);
  if (!diagnostics.hasErrors()) {
    std::vector<std::string> notes;  // discarded: Session collects them for the run
    safetyOf(*loaded.world, loaded.options, notes, diagnostics);
  }
  if (!diagnostics.hasErrors() && loaded.options.bound_stiffness) boundStiffness(loaded, diagnostics);
  if (!diagnostics.hasErrors() && !(loaded.options.duration > 0)) loaded.options.duration = scriptEnd(loaded.devices);
}

struct SceneAndRig {
  Scene scene;
  Rig rig;
};

/// None if the scene could not be read or names a forbidden rig file: then there is nothing more to check.
std::optional<SceneAndRig> readSceneAndRig(const Inputs& inputs, const RunOptions& options, Diagnostics& diagnostics) {
  const std::vector<Override> overrides = parseSets(inputs.sets, diagnostics);
  Scene scene = inputs.scene_xml.empty() ? loadScene(inputs.scene, overrides, diagnostics)
                                         : parseScene(inputs.scene_xml, inputs.scene, ".", overrides, diagnostics);
  if (!inputs.rig_xml.empty())
    return SceneAndRig{std::move(scene), parseRig(inputs.rig_xml, "rig of " + inputs.scene, ".", diagnostics)};
  const std::string rig_file = inputs.rig.empty() ? scene.default_rig : inputs.rig;
  Rig rig;
  const bool named = inputs.rig.empty() && !rig_file.empty();  // by the scene, not by the user
  if (named && !input::checkNamed({inputs.scene, 0, 0}, rig_file, diagnostics)) return std::nullopt;
  if (!rig_file.empty()) rig = loadRig(rig_file, diagnostics);
  if (inputs.rig.empty() && !options.bus && rig.bus && opensMoreThanASceneMay(*rig.bus))
    diagnostics.error(751, {rig_file, 0, 0},
                      "the scene names this rig, which opens the network or accepts commands; a scene may not do that",
                      "--rig " + rig_file + " allows it, --bus none runs without a bus");
  if (diagnostics.hasErrors() && scene.bodies.empty()) return std::nullopt;
  return SceneAndRig{std::move(scene), std::move(rig)};
}

/// A guide in a viewer needs a task, and a run that takes its orders.
void checkGuide(const Loaded& loaded, Diagnostics& diagnostics) {
  if (loaded.options.guide != RunOptions::Guide::kViewer) return;
  const SourceLocation where{"--guide viewer", 0, 0};
  if (!loaded.world->scene.assembly)
    diagnostics.error(kNothingToGuide, where, "the scene has no <assembly>, so there is nothing to guide",
                      "leave out --guide");
  if (!loaded.options.bus || !loaded.options.bus_commands)
    diagnostics.error(kGuideUnheard, where,
                      "the guide in a viewer sends its decisions as commands, this run takes none",
                      "add --bus loopback --bus-commands");
}

}  // namespace

Loaded loadWorld(const Inputs& inputs, RunOptions options, Diagnostics& diagnostics) {
  std::optional<SceneAndRig> read = readSceneAndRig(inputs, options, diagnostics);
  if (!read) return {};
  Loaded loaded = finish(std::move(read->scene), std::move(read->rig), std::move(options), diagnostics);
  checkGuide(loaded, diagnostics);
  addDevices(loaded, diagnostics);
  return loaded;
}

std::vector<std::string> plugInsFor(const Inputs& inputs, const RunOptions& options, Diagnostics& diagnostics) {
  const std::optional<SceneAndRig> read = readSceneAndRig(inputs, options, diagnostics);
  if (!read || diagnostics.hasErrors()) return {};
  const Plan plan =
      makePlan(read->scene, read->rig, bindDevices(read->scene, read->rig, diagnostics), options, diagnostics);
  std::set<std::string> names;
  for (const PlannedModule& module : plan.modules) names.insert(module.plugin);
  for (const PlannedEffect& effect : plan.effects) names.insert(effect.plugin);
  for (const PlannedDevice& device : plan.devices) names.insert(device.driver);
  if (!meshesOf(std::as_const(read->scene)).empty()) names.insert("mesh_import");
  if (plan.has("record")) names.insert("checksum");  // a recording carries one
  return {names.begin(), names.end()};
}

Loaded loadWithoutDevices(const RunTexts& texts, RunOptions options, Diagnostics& diagnostics) {
  Scene scene = parseScene(texts.scene_xml, texts.name, ".", {}, diagnostics);
  Rig rig;  // a scene without fingers needs none
  if (!texts.rig_xml.empty()) rig = parseRig(texts.rig_xml, "rig of " + texts.name, ".", diagnostics);
  if (diagnostics.hasErrors()) return {};
  return finish(std::move(scene), std::move(rig), std::move(options), diagnostics);
}

Loaded loadWorldFromText(const RunTexts& texts, RunOptions options, Diagnostics& diagnostics) {
  Loaded loaded = loadWithoutDevices(texts, std::move(options), diagnostics);
  addDevices(loaded, diagnostics);
  return loaded;
}

}  // namespace presa
