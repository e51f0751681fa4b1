#include "apps/presa/check/file_checks.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "apps/common/file_text.h"
#include "apps/common/terminal/text.h"
#include "devices/hand/motion.h"
#include "framework/device/device_settings.h"
#include "framework/scene/load.h"
#include "framework/scene/manifest.h"
#include "framework/scene/xml/xml.h"
#include "framework/walls/walls.h"

namespace presa::check {
namespace {

enum RigCheckCode { kUnknownDriver = 406 };

using terminal::format;

std::string lastCell(std::istringstream& line) {
  std::string cell;
  return std::getline(line, cell, ',') ? cell : std::string{};
}

/// The roles of a motion of keyframes, in order of their names.
std::set<std::string> rolesOf(const std::string& text) {
  std::set<std::string> roles;
  std::istringstream lines(text);
  int column = -1;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream cells(line);
    if (column >= 0) {
      std::string cell;
      for (int i = 0; i <= column; ++i) cell = lastCell(cells);
      if (!cell.empty()) roles.insert(cell);
      continue;
    }
    int at = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++at) {
      if (cell == "role") column = at;
    }
    if (column < 0) break;
  }
  return roles;
}

double endOf(const Motion& motion) { return motion.phase_times.empty() ? 0 : motion.phase_times.back(); }

std::string checkPhases(const std::string& file, Diagnostics& diagnostics) {
  const auto motion = readPhasedMotion(file, {}, diagnostics);
  return motion ? format("%zu phases, %.3g s", motion->phase_names.size(), endOf(*motion)) : "";
}

std::string checkKeyframes(const std::string& file, Diagnostics& diagnostics) {
  std::set<std::string> roles;
  try {
    roles = rolesOf(contentsOf(file));
  } catch (const std::exception&) {  // the reader says why
  }
  if (roles.empty()) readKeyframeMotion(file, {}, diagnostics);
  for (const std::string& role : roles) {
    if (!readKeyframeMotion(file, {.role = role}, diagnostics)) return {};
  }
  return format("keyframes of %zu role%s", roles.size(), roles.size() == 1 ? "" : "s");
}

void checkDriver(const DeviceBinding& binding, Diagnostics& diagnostics) {
  const Manifest* driver = findManifest(binding.driver);
  if (driver == nullptr || driver->kind != PluginKind::kDevice) {
    std::vector<std::string> known;
    for (const Manifest& manifest : manifests()) {
      if (manifest.kind == PluginKind::kDevice) known.push_back(manifest.name);
    }
    diagnostics.error(kUnknownDriver, binding.where,
                      "there is no driver " + quote(binding.driver) + didYouMean(binding.driver, known),
                      "presa device list names the drivers");
    return;
  }
  std::vector<std::string> settings;
  for (const Manifest::Attribute& setting : settingsOf(binding)) settings.push_back(setting.name);
  refuseUnknownSettings(binding, settings, diagnostics);
}

}  // namespace

FileKind kindOf(const std::string& file) {
  if (file.ends_with(".csv")) return FileKind::kMotion;
  Diagnostics unread;
  const auto document = xml::Document::load(file, unread);
  const std::string root = document ? document->root().name() : "";
  if (root == "rig") return FileKind::kRig;
  if (root == "motion") return FileKind::kMotion;
  if (root == "walls") return FileKind::kWalls;
  return root == "experiment" ? FileKind::kExperiment : FileKind::kScene;
}

std::string checkMotion(const std::string& file, Diagnostics& diagnostics) {
  return file.ends_with(".csv") ? checkKeyframes(file, diagnostics) : checkPhases(file, diagnostics);
}

std::string checkRig(const std::string& file, Diagnostics& diagnostics) {
  const Rig rig = loadRig(file, diagnostics);
  std::set<std::string> motions;
  for (const DeviceBinding& binding : rig.devices) {
    checkDriver(binding, diagnostics);
    if (const auto motion = binding.settings.find("motion"); motion != binding.settings.end())
      motions.insert(motion->second.value);
  }
  for (const std::string& motion : motions) checkMotion(motion, diagnostics);
  return format("%zu device%s, %zu motion%s", rig.devices.size(), rig.devices.size() == 1 ? "" : "s", motions.size(),
                motions.size() == 1 ? "" : "s");
}

std::string checkWalls(const std::string& file, Diagnostics& diagnostics) {
  const std::size_t count = walls::loadWalls(file, diagnostics).walls.size();
  return format("%zu wall%s", count, count == 1 ? "" : "s");
}

}  // namespace presa::check
