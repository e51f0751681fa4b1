#include "framework/device/output_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "framework/device/device_modules.h"

namespace presa {
namespace {

template <class... Numbers>
std::string text(const char* pattern, const std::string& role, Numbers... numbers) {
  std::array<char, 240> line;
  std::snprintf(line.data(), line.size(), pattern, role.c_str(), numbers...);
  return line.data();
}

}  // namespace

OutputLimits limitsFor(const DeviceRole& wanted, const DeviceBinding::Limits& allowed, const DeviceRating& rating,
                       std::vector<std::string>& notes) {
  OutputLimits limits;
  const double room = std::min(allowed.force.value_or(0.5 * rating.force), rating.force);
  limits.force = std::min(wanted.limits.force, room);
  limits.force_rate = std::min(wanted.limits.force_rate, allowed.force_rate.value_or(wanted.limits.force_rate));
  limits.soft_start = allowed.soft_start.value_or(limits.soft_start);
  limits.continuous = std::min(allowed.continuous.value_or(rating.continuous), rating.continuous);
  limits.heating_time = rating.heating_time;
  limits.records_overload = allowed.records_overload;
  limits.speed = allowed.speed.value_or(rating.speed);
  limits.passivity = allowed.passivity;
  if (limits.force < wanted.limits.force) {
    notes.push_back(text("%s: forces up to %.3g N (the scene asks for %.3g, the device's nominal force is %.3g N)",
                         wanted.role, limits.force, wanted.limits.force, rating.force));
    if (!allowed.force && room < rating.force) notes.back() += ": half of it unless the rig says <limits force=\"…\"/>";
  }
  const double down = limits.force / limits.force_rate;
  if (std::isfinite(rating.force) && down > DeviceOutput::kSilentZero)
    notes.push_back(
        text("%s: from %.3g N to zero takes %.1f ms at %.3g N/s: a silent device has that long at its force",
             wanted.role, limits.force, 1e3 * down, limits.force_rate));
  return limits;
}

}  // namespace presa
