#include "devices/novint_falcon/settings.h"

#include <cmath>
#include <limits>
#include <optional>

#include "devices/novint_falcon/codes.h"
#include "devices/novint_falcon/firmware.h"
#include "framework/input/folders.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::falcon {
namespace {

struct NumberRule {
  std::size_t count = 1;
  double min = 0;  ///< each number must be greater
  const char* words = "";
  double max = std::numeric_limits<double>::max();
};

/// The setting as numbers that satisfy the rule; nullopt when it is missing, or invalid (reported).
std::optional<std::vector<double>> numbersOf(const DeviceBinding& binding, const std::string& key,
                                             const NumberRule& rule, Diagnostics& diagnostics) {
  const auto found = binding.settings.find(key);
  if (found == binding.settings.end()) return {};
  std::vector<double> numbers;
  bool good = true;
  for (const std::string& word : xml::splitWords(found->second.value)) {
    double& number = numbers.emplace_back();
    good = good && xml::readNumber(word, number) == xml::NumberKind::kFinite && number > rule.min && number <= rule.max;
  }
  if (good && numbers.size() == rule.count) return numbers;
  diagnostics.error(kBadNumber, found->second.where,
                    key + " must be " + rule.words + ", found " + quote(found->second.value));
  return {};
}

void readUpTo(const DeviceBinding& binding, const std::string& key, const NumberRule& rule, double& value,
              Diagnostics& diagnostics) {
  if (const auto number = numbersOf(binding, key, rule, diagnostics)) value = (*number)[0];
}

void readPositive(const DeviceBinding& binding, const std::string& key, double& value, Diagnostics& diagnostics) {
  readUpTo(binding, key, {1, 0, "a number above 0"}, value, diagnostics);
}

Pose readBase(const DeviceBinding& binding, Diagnostics& diagnostics) {
  constexpr double kAny = std::numeric_limits<double>::lowest();
  Pose X_WD;
  if (const auto p = numbersOf(binding, "pos", {3, kAny, "3 numbers"}, diagnostics))
    X_WD.p = {(*p)[0], (*p)[1], (*p)[2]};
  if (const auto q = numbersOf(binding, "quat", {4, kAny, "4 numbers, w x y z"}, diagnostics)) {
    const Quat turn((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
    const double norm = turn.norm();
    if (norm > 1e-6 && std::isfinite(norm))
      X_WD.q = turn.normalized();
    else
      diagnostics.error(kBadNumber, binding.settings.at("quat").where, "quat must not be zero");
  }
  return X_WD;
}

}  // namespace

FalconSettings readSettings(const DeviceBinding& binding, const RunOptions& options, Diagnostics& diagnostics) {
  FalconSettings settings;
  settings.role = binding.role;
  settings.where = binding.where;
  settings.realtime = options.realtime;
  settings.X_WD = readBase(binding, diagnostics);
  readPositive(binding, "scale", settings.scale, diagnostics);
  readUpTo(binding, "counts_per_torque", {1, 0, "a number above 0, at most 12500", kMaxCountsPerTorque},
           settings.link.counts_per_torque, diagnostics);
  readUpTo(binding, "max_speed", {1, 0, "a number above 0, at most 3", kFastestGrip}, settings.link.max_speed,
           diagnostics);
  readPositive(binding, "homing_wait", settings.homing_wait, diagnostics);
  if (const auto serial = binding.settings.find("serial"); serial != binding.settings.end())
    settings.serial = serial->second.value;
  if (const auto firmware = binding.settings.find("firmware");
      firmware != binding.settings.end() &&
      input::checkNamed(firmware->second.where, firmware->second.value, diagnostics))
    settings.firmware = readFirmware(firmware->second.value, firmware->second.where, diagnostics);
  return settings;
}

}  // namespace presa::falcon
