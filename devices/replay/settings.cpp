#include "devices/replay/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "framework/core/schedule/rates.h"
#include "framework/input/folders.h"
#include "framework/record/record_plugin.h"

namespace presa {
namespace {

enum Code : int {
  kNoFile = 440,
  kNotARecording = 441,
  kNoSuchRole = 442,
  kWhichRole = 443,
  kBadValue = 444,
  kNoRate = 445,
};

/// Contents of a recording, by role.
struct Contents {
  std::string file;
  std::filesystem::file_time_type written;
  std::vector<std::pair<std::string, std::shared_ptr<const RecordedPath>>> fingers;
  bool complete = true;
  std::uint64_t dropped = 0;
  double period = 0;
};

std::shared_ptr<const RecordedPath> pathOf(const RecordedTable& finger, const RecordedSamples& samples) {
  auto path = std::make_shared<RecordedPath>();
  path->period = samples.haptic_period;
  const auto column = [&](const char* name) -> const std::vector<double>& { return finger.values(name); };
  const auto &px = column("p_WH_x"), &py = column("p_WH_y"), &pz = column("p_WH_z");
  const auto &vx = column("v_WH_x"), &vy = column("v_WH_y"), &vz = column("v_WH_z");
  const auto &phase = column("phase"), &valid = column("valid");
  path->rows.reserve(samples.time.size());
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const auto bits = static_cast<unsigned>(valid[i]);
    FingerInput sample{.p_WH = {px[i], py[i], pz[i]},
                       .v_WH = {vx[i], vy[i], vz[i]},
                       .phase = static_cast<std::int32_t>(phase[i]),
                       .valid = (bits & 1U) != 0,
                       .age = (bits & 1U) != 0 ? 0 : 1.0,  // bridged in the recording; must not be bridged again
                       .lost = (bits & 2U) != 0};
    path->rows.push_back({samples.time[i] - samples.time.front(), sample});
  }
  return path;
}

/// The fingers of a file. The last file is cached, since a rig names it for each finger and is checked more than once
/// before a run. Throws InputError.
const Contents& contentsOf(const std::string& file) {
  static Contents kept;
  std::error_code unknown;
  const auto written = std::filesystem::last_write_time(file, unknown);
  if (!kept.file.empty() && kept.file == file && kept.written == written) return kept;
  const RecordedSamples samples = recordPlugin().samples(file);
  kept = {file, written, {}, samples.complete, samples.dropped, samples.haptic_period};
  for (const RecordedTable& finger : samples.fingers) kept.fingers.emplace_back(finger.name, pathOf(finger, samples));
  return kept;
}

const DeviceBinding::Setting* settingOf(const DeviceBinding& binding, const std::string& key) {
  const auto found = binding.settings.find(key);
  return found == binding.settings.end() ? nullptr : &found->second;
}

const Contents* openFile(const DeviceBinding& binding, Diagnostics& diagnostics) {
  const DeviceBinding::Setting* file = settingOf(binding, "file");
  if (file == nullptr) {
    diagnostics.error(kNoFile, binding.where, "role '" + binding.role + "': driver 'replay' needs the setting 'file'",
                      "add <set key=\"file\" value=\"RUN.h5\"/>, made with presa run --record");
    return nullptr;
  }
  if (!input::checkNamed(file->where, file->value, diagnostics)) return nullptr;
  try {
    const Contents& contents = contentsOf(file->value);
    if (contents.period > 0) return &contents;
    diagnostics.error(kNoRate, file->where, quote(file->value) + " does not state its haptic rate");
  } catch (const InputError& error) {
    diagnostics.error(kNotARecording, file->where, "the recording cannot be used", error.what());
  }
  return nullptr;
}

std::shared_ptr<const RecordedPath> chooseFinger(const DeviceBinding& binding, const Contents& contents,
                                                 std::string& chosen, Diagnostics& diagnostics) {
  const DeviceBinding::Setting* named = settingOf(binding, "role");
  chosen = named != nullptr ? named->value : binding.role;
  std::vector<std::string> roles;
  for (const auto& [role, path] : contents.fingers) {
    if (role == chosen) return path;
    roles.push_back(role);
  }
  if (named == nullptr && roles.size() == 1) {
    chosen = roles.front();
    return contents.fingers.front().second;
  }
  std::string list;
  for (const std::string& role : roles) list += (list.empty() ? "" : ", ") + role;
  if (roles.empty())
    diagnostics.error(kNoSuchRole, binding.where, quote(contents.file) + " holds no finger");
  else if (named != nullptr)
    diagnostics.error(kNoSuchRole, named->where,
                      "no finger of the recording is called " + quote(chosen) + didYouMean(chosen, roles),
                      "its fingers: " + list);
  else
    diagnostics.error(kWhichRole, binding.where,
                      "role '" + binding.role + "': none of the recorded fingers has this name",
                      "add <set key=\"role\" value=\"NAME\"/>; its fingers: " + list);
  return nullptr;
}

double readSpeed(const DeviceBinding& binding, Diagnostics& diagnostics) {
  const DeviceBinding::Setting* setting = settingOf(binding, "speed");
  if (setting == nullptr) return 1;
  double value = 0;
  const char* end = setting->value.data() + setting->value.size();
  const auto [rest, status] = std::from_chars(setting->value.data(), end, value);
  if (status == std::errc{} && rest == end && value >= 0.01 && value <= 100) return value;
  diagnostics.error(kBadValue, setting->where,
                    "speed must be a number from 0.01 to 100, found " + quote(setting->value),
                    "1: as recorded; 0.5: half as fast");
  return 1;
}

bool readLostAtEnd(const DeviceBinding& binding, Diagnostics& diagnostics) {
  const DeviceBinding::Setting* setting = settingOf(binding, "at_end");
  if (setting == nullptr || setting->value == "hold") return false;
  if (setting->value != "lost")
    diagnostics.error(kBadValue, setting->where, "at_end must be hold or lost, found " + quote(setting->value),
                      "hold: the finger keeps its last position; lost: as if unplugged");
  return true;
}

std::vector<std::string> notesOn(const std::string& role, const std::string& finger, const Contents& contents,
                                 const ReplaySettings& settings, double period) {
  std::array<char, 320> line;
  std::snprintf(line.data(), line.size(), "%s: replays '%s' of %s, %.3f s at %.0f Hz; it does not yield to forces",
                role.c_str(), finger.c_str(), contents.file.c_str(), settings.path->end() / settings.speed,
                1 / contents.period);
  std::vector<std::string> notes{line.data()};
  const double step = period * settings.speed / contents.period;  // recorded ticks per tick
  if (std::abs(step - std::round(step)) > 1e-9 || step < 0.5)
    notes.push_back(role + ": ticks fall between the recorded ones: straight lines join those");
  if (!contents.complete) notes.push_back(role + ": the recorded run was killed: it ends early");
  if (contents.dropped > 0) notes.push_back(role + ": rows of the recording are missing: straight lines bridge them");
  return notes;
}

}  // namespace

ReplaySettings readReplaySettings(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  ReplaySettings settings;
  settings.speed = readSpeed(binding, diagnostics);
  settings.lost_at_end = readLostAtEnd(binding, diagnostics);
  if (const Contents* contents = openFile(binding, diagnostics)) {
    std::string finger;
    settings.path = chooseFinger(binding, *contents, finger, diagnostics);
    if (settings.path)
      settings.notes =
          notesOn(binding.role, finger, *contents, settings, RateTable(world.scene.rates).period(RateGroup::kHaptic));
  }
  if (diagnostics.errorCount() > before) settings.path = nullptr;
  return settings;
}

}  // namespace presa
