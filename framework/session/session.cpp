#include "framework/session/session.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/assembly/guide_module.h"
#include "framework/assembly/told_guide_module.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/graph/graph_builder.h"
#include "framework/device/device_modules.h"
#include "framework/device/device_plugin.h"
#include "framework/device/device_settings.h"
#include "framework/device/driven_device.h"
#include "framework/device/frame_watch.h"
#include "framework/device/framed_device.h"
#include "framework/device/supervision/supervised_device.h"
#include "framework/device/transport_watch.h"
#include "framework/haptics/plugin_host.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/record/record_plugin.h"
#include "framework/scene/ages.h"
#include "framework/scene/manifest.h"
#include "framework/scene/xml/value_rule.h"
#include "framework/session/module_plugin.h"

namespace presa {
namespace {

enum SessionCode { kNoButton = 467, kImpatient = 656 };

/// Null if the rig has no device for the role.
const DeviceBinding* bindingOf(const Rig& rig, const std::string& role) {
  const auto found = std::find_if(rig.devices.begin(), rig.devices.end(),
                                  [&](const DeviceBinding& binding) { return binding.role == role; });
  return found == rig.devices.end() ? nullptr : &*found;
}

/// Settings that the driver's manifest does not list (E401). A driver without a manifest checks its own.
void checkSettings(const std::string& driver, const std::vector<DeviceBinding>& bindings, Diagnostics& diagnostics) {
  if (findManifest(driver) == nullptr) return;
  for (const DeviceBinding& binding : bindings) {
    std::vector<std::string> known;
    for (const Manifest::Attribute& setting : settingsOf(binding)) known.push_back(setting.name);
    refuseUnknownSettings(binding, known, diagnostics);
  }
}

/// ": did you mean 'scripted'?"
std::string nearestDriver(const std::string& driver) {
  std::vector<std::string> drivers;
  for (const Manifest& manifest : manifests())
    if (manifest.kind == PluginKind::kDevice) drivers.push_back(manifest.name);
  return didYouMean(driver, drivers);
}

/// The devices of one driver, in the order of `bindings`, made in one call because two of them may be one hand. Every
/// failure is an error at its binding.
DeviceList createOf(const std::string& driver, const std::vector<DeviceBinding>& bindings,
                    const std::shared_ptr<const World>& world, const RunOptions& options, Diagnostics& diagnostics) {
  const auto refuseAll = [&](const std::string& what, const std::string& help) {
    for (const DeviceBinding& binding : bindings)
      diagnostics.error(406, binding.where, "role '" + binding.role + "': driver '" + driver + "' " + what, help);
    return DeviceList(bindings.size());
  };
  try {
    const std::size_t errors_before = diagnostics.errorCount();
    checkSettings(driver, bindings, diagnostics);
    DeviceList made = devicePlugin(driver).create(bindings, world, options, diagnostics);
    const auto there = made.size() - static_cast<std::size_t>(std::count(made.begin(), made.end(), nullptr));
    if (made.size() == bindings.size() && (there == made.size() || diagnostics.errorCount() > errors_before))
      return made;
    return refuseAll("made " + std::to_string(there) + " devices for " + std::to_string(bindings.size()) + " roles",
                     "report this to the author of the driver");
  } catch (const InputError& error) {
    return refuseAll("cannot be loaded" + nearestDriver(driver), error.what());
  }
}

void checkFrame(const Device* device, const DeviceBinding& binding, Diagnostics& diagnostics) {
  if (device == nullptr || binding.frame == kWorldFrame || !(device->looks() || device->points())) return;
  diagnostics.error(428, binding.where,
                    "role '" + binding.role + "': driver '" + binding.driver +
                        "' sees the world and moves in it, found in=\"" + binding.frame + "\"",
                    "such a driver stands in the world");
}

/// A button of a driven frame that no device in it has.
void checkButtons(const Rig& rig, const DeviceList& devices, const Plan& plan, Diagnostics& diagnostics) {
  for (const Frame& frame : rig.frames) {
    int most = 0;
    for (std::size_t f = 0; f < devices.size(); ++f)
      if (std::ranges::find(plan.devices[f].frames, frame.name) != plan.devices[f].frames.end())
        most = std::max(most, devices[f]->buttons());
    const auto check = [&](const std::optional<Frame::Button>& button) {
      if (!button || !button->number || *button->number < most) return;
      diagnostics.error(kNoButton, button->where,
                        "no device in frame '" + frame.name + "' has a button " + std::to_string(*button->number),
                        most > 0 ? "its devices have buttons 0 to " + std::to_string(most - 1)
                                 : "its devices have none; without the attribute the keys of the window do it");
    };
    check(frame.clutch);
    if (frame.zoom) check(frame.zoom->in);
    if (frame.zoom) check(frame.zoom->out);
  }
}

}  // namespace

DeviceList createDevices(const std::shared_ptr<const World>& world, const RunOptions& options, const Plan& plan,
                         Diagnostics& diagnostics) {
  DeviceList devices(plan.devices.size());
  std::map<std::string, std::vector<std::size_t>> places;  // of each driver's roles
  for (std::size_t f = 0; f < plan.devices.size(); ++f) places[plan.devices[f].driver].push_back(f);
  for (const auto& [driver, roles] : places) {
    std::vector<DeviceBinding> bindings;
    for (const std::size_t f : roles) bindings.push_back(*bindingOf(world->rig, plan.devices[f].role));
    DeviceList made = createOf(driver, bindings, world, options, diagnostics);
    for (std::size_t i = 0; i < roles.size(); ++i) {
      checkFrame(made[i].get(), bindings[i], diagnostics);
      devices[roles[i]] = std::move(made[i]);
    }
  }
  if (std::ranges::all_of(devices, [](const auto& device) { return device != nullptr; }))
    checkButtons(world->rig, devices, plan, diagnostics);
  std::erase(devices, nullptr);
  return devices;
}

std::unique_ptr<View> makeView(std::shared_ptr<const World> world, const RunOptions& options) {
  auto module =
      pluginTable<ModulePlugin>(manifestGiving("view").name, "presaModulePlugin").create(std::move(world), options);
  return std::unique_ptr<View>(&dynamic_cast<View&>(*module.release()));
}

std::vector<std::string> whileOpening(const Plan& plan) {
  std::vector<std::string> lines;
  for (const PlannedDevice& planned : plan.devices) {
    if (const char* what = devicePlugin(planned.driver).while_opening)
      lines.push_back(planned.role + " (" + planned.driver + "): " + what);
  }
  return lines;
}

std::vector<std::string> engineVersions(const Plan& plan) {
  std::vector<std::string> versions;
  for (const PlannedModule& planned : plan.modules) {
    if (planned.plugin == "record") continue;
    const auto& table = pluginTable<ModulePlugin>(planned.plugin, "presaModulePlugin");
    if (table.library != nullptr) versions.push_back(table.library());
  }
  return versions;
}

namespace {

std::unique_ptr<Module> makeModule(const PlannedModule& planned, const std::shared_ptr<const World>& world,
                                   const RunOptions& options) {
  auto module = pluginTable<ModulePlugin>(planned.plugin, "presaModulePlugin").create(world, options);
  if (module != nullptr && module->group() == planned.group) return module;
  const Manifest* manifest = findManifest(planned.plugin);
  refuse(596, manifest == nullptr ? planned.plugin : manifest->file,
         "the library of module '" + planned.plugin + "' makes " +
             (module == nullptr ? "nothing" : std::string("a module of the ") + toString(module->group()) + " rate") +
             ", its manifest says rate=\"" + toString(planned.group) + "\"",
         "report this to the author of the plug-in");
}

/// The rating of the driver that the rig names, or kImaginedRating without one: replays and studies bring their own
/// devices.
const DeviceRating& ratingOf(const DeviceBinding* binding) {
  return binding == nullptr ? kImaginedRating : devicePlugin(binding->driver).rating;
}

/// Scene and rig can only shorten the watchdog of a rating, so that one below two periods of the dynamics is an error.
void checkPatience(const Scene& scene, const DeviceRole& role, const FingerSafety& safety, Diagnostics& findings) {
  const bool moves = std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.fixed; });
  const double shortest = ages::shortestWatchdog(scene.rates.dynamics);
  if (!moves || safety.watchdog >= shortest * (1 - 1e-9)) return;
  const auto shown = [](double value) { return xml::numberText(std::round(value * 1e6) * 1e-6); };
  findings.error(kImpatient, role.where,
                 "the force of '" + role.role + "' would fade although the dynamics is on time: its driver is rated " +
                     "for a watchdog of " + shown(1e3 * safety.watchdog) + " ms, found dynamics at " +
                     shown(scene.rates.dynamics) + " Hz",
                 "rates/dynamics=\"" + shown(ages::kPeriods / safety.watchdog) + "\" or more");
}

/// A frame of scale s multiplies forces by s on their way to the device, and its velocities by s on their way to the
/// world: the limits of the device hold at every scale.
void limitForZoom(const ZoomRange& zoom, const std::string& role, OutputLimits& limits,
                  std::vector<std::string>& notes) {
  limits.speed *= zoom.min;
  if (!(zoom.max > 1)) return;
  limits.force /= zoom.max;
  limits.force_rate /= zoom.max;
  limits.continuous /= zoom.max;
  notes.push_back(role + ": at most " + xml::numberText(limits.force) + " N in the scene: its frame zooms to " +
                  xml::numberText(zoom.max) + " times, where the device gives " +
                  xml::numberText(zoom.max * limits.force) + " N");
}

}  // namespace

std::vector<FingerSafety> safetyOf(const World& world, const RunOptions& options, std::vector<std::string>& notes,
                                   Diagnostics& findings) {
  std::vector<FingerSafety> safety;
  for (const DeviceRole& role : world.scene.devices) {
    const DeviceBinding* binding = bindingOf(world.rig, role.role);
    safety.push_back(
        safetyFor(role, binding == nullptr ? DeviceBinding{} : *binding, ratingOf(binding), notes, findings));
    checkPatience(world.scene, role, safety.back(), findings);
    safety.back().limits.force *= options.force_share;
    safety.back().limits.torque *= options.force_share;
    limitForZoom(zoomRange(world.rig, role.role), role.role, safety.back().limits, notes);
  }
  return safety;
}

Session::Session(Loaded loaded, RunControl& control, Options options)
    : world_(std::move(loaded.world)),
      options_(std::move(loaded.options)),
      plan_(std::move(loaded.plan)),
      devices_(std::move(options.devices)) {
  Diagnostics said;  // discarded: reported when the world was loaded
  std::vector<FingerSafety> safety = safetyOf(*world_, options_, notes_, said);
  if (devices_.empty()) {
    devices_ = std::move(loaded.devices);
    if (options.open_devices) openDevices();
    putIntoFrames(safety);
  }
  if (options.wrap) devices_ = options.wrap(std::move(devices_));
  for (std::size_t f = 0; f < devices_.size(); ++f) {
    // a tool without orientation gets no torque, and its output stage does no work for one
    if (!devices_[f]->measuresOrientation()) safety[f].limits.torque = 0;
    devices_[f] = watched(std::move(devices_[f]), safety[f].limits,
                          ratingOf(bindingOf(world_->rig, world_->scene.devices[f].role)));
  }
  GraphBuilder builder;
  if (!devices_.empty()) builder.add(std::make_unique<DeviceInput>(devices_, control));
  if (!world_->rig.frames.empty() && frames_) frame_watch_ = &builder.add(std::make_unique<FrameWatch>(frames_));
  if (world_->scene.assembly && (options.guide || options_.view != RunOptions::View::kNone)) {
    if (options_.guide == RunOptions::Guide::kBeside) builder.add(std::make_unique<GuideModule>(world_));
    if (options_.guide == RunOptions::Guide::kViewer) builder.add(std::make_unique<ToldGuideModule>(world_->scene));
  }
  for (const PlannedModule& planned : plan_.modules) builder.add(load(planned));
  offerPointer();
  if (!devices_.empty()) {
    output_ = &builder.add(std::make_unique<DeviceOutput>(devices_, safety, world_->scene.rates, options_.realtime));
  }
  monitor_ = &builder.add(std::make_unique<Monitor>(world_, options_.duration, releaseTime(), options.trace_rate));
  for (auto& module : options.more) builder.add(std::move(module));
  builder.connectByName();
  graph_ = builder.build();
  if (recorder_ == nullptr) return;
  schedule_ = std::make_unique<ScheduleLog>();
  schedule_->inputs = graph_.scheduleInputs();
  recorder_->attach(*schedule_);
}

void Session::offerPointer() {
  std::vector<std::size_t> fingers;
  bool drives = false;
  for (std::size_t f = 0; f < devices_.size(); ++f) {
    const bool driven = frames_ && frames_->drives(f);  // then the window moves its frames, and no finger
    drives = drives || driven;
    if (devices_[f]->points() && !driven) fingers.push_back(f);
  }
  if (view_ != nullptr && drives) view_->offerFrames();
  if (view_ != nullptr && !fingers.empty()) view_->offerPointer(fingers);
}

std::optional<std::string> Session::brokenPlugin() const {
  for (const PluginHost* host : plugin_hosts_) {
    if (auto broken = host->brokenPlugin()) return broken;
  }
  return std::nullopt;
}

Session::~Session() {
  for (const auto& device : devices_) device->close();
}

std::vector<Diagnostic> Session::reopenDevices(const std::atomic<bool>& stop) {
  std::vector<Diagnostic> findings;
  for (const auto& device : devices_) {
    try {
      device->reopen(stop);
    } catch (const InputError& error) {
      const auto& all = error.diagnostics().all();
      findings.insert(findings.end(), all.begin(), all.end());
    }
  }
  return findings;
}

void Session::openDevices() {
  for (std::size_t f = 0; f < devices_.size() && options_.realtime; ++f) {
    const DeviceBinding& binding = *bindingOf(world_->rig, plan_.devices[f].role);
    if (!devicePlugin(binding.driver).hardware) continue;
    devices_[f] = std::make_unique<SupervisedDevice>(std::move(devices_[f]), binding, world_->rig.file);
  }
  for (const auto& device : devices_) device->open();
}

void Session::putIntoFrames(const std::vector<FingerSafety>& safety) {
  const auto stands = [](const DeviceBinding& binding) { return binding.frame != kWorldFrame; };
  if (world_->rig.frames.empty() && std::ranges::none_of(world_->rig.devices, stands)) return;
  const auto tree = frames_ = std::make_shared<FrameTree>(world_->rig, world_->scene.devices);
  for (std::size_t f = 0; f < devices_.size(); ++f) {
    const DeviceBinding* binding = bindingOf(world_->rig, world_->scene.devices[f].role);
    const int frame = binding == nullptr ? FrameTree::kWorld : tree->find(binding->frame);
    if (frame == FrameTree::kWorld && !tree->carries(f)) continue;
    const double zoom = plan_.devices[f].zoom;
    const OutputLimits& limits = safety[f].limits;
    if (tree->drives(f))
      devices_[f] = std::make_unique<DrivenDevice>(std::move(devices_[f]), tree, f,
                                                   DrivenDevice::Slew{zoom * limits.force_rate, limits.torque_rate});
    devices_[f] = std::make_unique<FramedDevice>(std::move(devices_[f]), tree, frame, f);
  }
}

std::unique_ptr<Module> Session::load(const PlannedModule& planned) {
  if (planned.plugin == "record") {
    auto recorder = recordPlugin().create(world_, options_, recordedDevices());
    recorder_ = recorder.get();
    return recorder;
  }
  auto module = makeModule(planned, world_, options_);
  std::ranges::copy(module->notes(), std::back_inserter(notes_));
  if (auto* view = dynamic_cast<View*>(module.get())) view_ = view;
  if (const auto* sound = dynamic_cast<const sound::SoundOutput*>(module.get())) sound_ = sound;
  if (const auto* host = dynamic_cast<const PluginHost*>(module.get())) plugin_hosts_.push_back(host);
  if (auto* assembly = dynamic_cast<AssemblyControl*>(module.get())) assembly_ = assembly;
  return module;
}

RecordedDevices Session::recordedDevices() const {
  RecordedDevices recorded;
  for (std::size_t f = 0; f < devices_.size(); ++f) {
    if (devices_[f]->measuresOrientation()) recorded.tools.push_back(f);
    recorded.phases.push_back(devices_[f]->phases());
  }
  if (frames_)
    for (const Frame& frame : world_->rig.frames) recorded.frames.push_back(frame.name);
  recorded.guided = world_->scene.assembly && options_.guide == RunOptions::Guide::kViewer;
  return recorded;
}

double Session::phaseStart(const std::string& phase) const {
  if (const auto intent = phaseIntentOf(phase)) {
    for (const auto& device : devices_) {
      if (const auto span = firstSpanOf(*intent, device->phaseIntents(), device->phaseTimes())) return span->begin;
    }
    return std::numeric_limits<double>::infinity();  // such a word is an intent, and no name
  }
  for (const auto& device : devices_) {
    const auto names = device->phases();
    const auto times = device->phaseTimes();
    const auto found = std::find(names.begin(), names.end(), phase);
    const auto phase_index = static_cast<std::size_t>(found - names.begin());
    if (phase_index < std::min(names.size(), times.size())) return times[phase_index];
  }
  return std::numeric_limits<double>::infinity();
}

double Session::releaseTime() const {
  bool said = false;
  for (const auto& device : devices_) {
    const auto intents = device->phaseIntents();
    if (const auto span = firstSpanOf(PhaseIntent::kRelease, intents, device->phaseTimes())) return span->begin;
    said = said || std::any_of(intents.begin(), intents.end(), [](PhaseIntent i) { return i != PhaseIntent::kNone; });
  }
  return said ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace presa
