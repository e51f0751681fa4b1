#include <algorithm>
#include <filesystem>

#include "framework/core/state/limits.h"
#include "framework/scene/manifest.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/schemas.h"

namespace presa {
namespace {

using xml::Element;

enum RigCode { kRigVersion = 412, kDuplicateRole = 413, kDuplicateKey = 414, kRigCapacity = 415 };

const xml::Schema& rigSchema() {
  static const xml::Schema schema(schemas::rig);
  return schema;
}

/// Keys of the settings that are files.
std::vector<std::string> filesOf(const DeviceBinding& binding) {
  std::vector<std::string> keys;
  for (const Manifest::Attribute& setting : settingsOf(binding)) {
    if (setting.type == "file" && binding.settings.contains(setting.name)) keys.push_back(setting.name);
  }
  return keys;
}

void addSetting(DeviceBinding& binding, const std::string& key, const DeviceBinding::Setting& setting,
                const SourceLocation& where, Diagnostics& diagnostics) {
  const auto [found, is_new] = binding.settings.try_emplace(key, setting);
  if (is_new) return;
  diagnostics.error(kDuplicateKey, where, "device " + quote(binding.role) + " sets " + quote(key) + " twice",
                    "the first is in line " + std::to_string(found->second.where.line));
}

DeviceBinding::Limits readLimits(const Element& device) {
  DeviceBinding::Limits limits;
  for (const Element& element : device.children("limits")) {
    limits.force = optionalNumber(element, "force");
    limits.force_rate = optionalNumber(element, "force_rate");
    limits.soft_start = optionalNumber(element, "soft_start");
    limits.continuous = optionalNumber(element, "continuous");
    limits.speed = optionalNumber(element, "speed");
    limits.torque = optionalNumber(element, "torque");
    limits.torque_rate = optionalNumber(element, "torque_rate");
    limits.continuous_torque = optionalNumber(element, "continuous_torque");
    limits.angular_speed = optionalNumber(element, "angular_speed");
    limits.records_overload = element.attribute("past_continuous") == "record";
    limits.passivity = element.boolean("passivity", false);
  }
  return limits;
}

DeviceBinding readBinding(const Element& device, Diagnostics& diagnostics) {
  DeviceBinding binding;
  binding.role = device.attribute("role");
  binding.driver = device.attribute("driver");
  binding.frame = device.attribute("in");
  binding.where = device.where();
  if (device.hasAttribute("serial")) {
    const SourceLocation where = device.where("serial");
    addSetting(binding, "serial", {device.attribute("serial"), where}, where, diagnostics);
  }
  for (const Element& set : device.children("set")) {
    if (!set.hasAttribute("key") || set.flawed("key")) continue;
    addSetting(binding, set.attribute("key"), {set.attribute("value"), set.where("value")}, set.where("key"),
               diagnostics);
  }
  binding.limits = readLimits(device);
  return binding;
}

/// Makes the paths of the settings that are files absolute, in the document too.
void resolvePaths(const Element& device, const std::string& directory, DeviceBinding& binding) {
  for (const std::string& key : filesOf(binding)) {
    std::string& path = binding.settings.at(key).value;
    path = resolvePath(path, directory);
    for (Element set : device.children("set")) {
      if (set.attribute("key") == key) set.setAttribute("value", path);
    }
  }
}

void checkRoles(const std::vector<Element>& devices, Diagnostics& diagnostics) {
  std::map<std::string, SourceLocation> first;
  for (const Element& device : devices) {
    if (!device.hasAttribute("role") || device.flawed("role")) continue;
    const auto [found, is_new] = first.try_emplace(device.attribute("role"), device.where("role"));
    if (is_new) continue;
    diagnostics.error(kDuplicateRole, device.where("role"),
                      "a second device plays the role " + quote(device.attribute("role")),
                      "the first is in line " + std::to_string(found->second.line));
  }
  if (devices.size() > static_cast<std::size_t>(kMaxFingers)) {
    diagnostics.error(kRigCapacity, devices[static_cast<std::size_t>(kMaxFingers)].where(),
                      "the rig has " + std::to_string(devices.size()) + " devices, at most " +
                          std::to_string(kMaxFingers) + " are possible");
  }
}

Rig readDocument(xml::Document& document, const std::string& directory, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errorCount();
  Rig rig;
  document.validate(rigSchema(), diagnostics);
  const Element root = document.root();
  if (root.name() == rigSchema().root().name) {
    checkVersion(root, "rig", kRigVersion, diagnostics);
    checkRoles(root.children("device"), diagnostics);
    checkFrames(root, diagnostics);
    document.writeDefaults(rigSchema());
    rig.name = root.attribute("name");
    for (const Element& device : root.children("device")) {
      rig.devices.push_back(readBinding(device, diagnostics));
      resolvePaths(device, directory, rig.devices.back());
    }
    for (Element bus : root.children("bus"))
      if (bus.hasAttribute("keys")) bus.setAttribute("keys", resolvePath(bus.attribute("keys"), directory));
    rig.frames = readFrames(root);
    rig.bus = readBus(root);
    rig.resolved_xml = document.text();
  }
  if (diagnostics.errorCount() > errors_before) rig = {};  // all or nothing
  rig.file = document.name();
  return rig;
}

Rig emptyRig(const std::string& file) {
  Rig rig;
  rig.file = file;
  return rig;
}

}  // namespace

Rig loadRig(const std::string& file, Diagnostics& diagnostics) {
  const auto document = xml::Document::load(file, diagnostics);
  if (!document) return emptyRig(file);
  return readDocument(*document, std::filesystem::path(file).parent_path().string(), diagnostics);
}

Rig parseRig(const std::string& xml, const std::string& name, const std::string& directory, Diagnostics& diagnostics) {
  const auto document = xml::Document::parse(xml, name, diagnostics);
  if (!document) return emptyRig(name);
  return readDocument(*document, directory, diagnostics);
}

std::vector<std::string> filesNamedBy(const Rig& rig) {
  std::vector<std::string> files;
  for (const DeviceBinding& device : rig.devices) {
    for (const std::string& key : filesOf(device)) files.push_back(device.settings.at(key).value);
  }
  return files;
}

}  // namespace presa
