#include "framework/device/device_settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace presa {

void refuseUnknownSettings(const DeviceBinding& binding, const std::vector<std::string>& known,
                           Diagnostics& diagnostics) {
  std::string list;
  for (const std::string& key : known) list += (list.empty() ? "" : ", ") + key;
  for (const auto& [key, setting] : binding.settings) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    diagnostics.error(401, setting.where,
                      "driver '" + binding.driver + "' has no setting '" + key + "'" + didYouMean(key, known),
                      "settings: " + list);
  }
}

double positiveSetting(const DeviceBinding& binding, const std::string& key, double fallback,
                       Diagnostics& diagnostics) {
  const auto found = binding.settings.find(key);
  if (found == binding.settings.end()) return fallback;
  const std::string& text = found->second.value;
  double value = 0;
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || rest != text.data() + text.size() || !(value > 0) || !std::isfinite(value)) {
    diagnostics.error(403, found->second.where, key + " must be a positive number, found '" + text + "'");
    return fallback;
  }
  return value;
}

}  // namespace presa
