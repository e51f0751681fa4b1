#include "framework/device/device_plugin.h"

namespace presa {

const DevicePlugin& devicePlugin(const std::string& driver) {
  const auto& table = pluginTable<DevicePlugin>(driver, "presaDevicePlugin");
  if (!isSound(table.rating)) {
    Diagnostics diagnostics;
    diagnostics.error(
        655, {"presa_" + driver + ".so", 0, 0},
        "the driver's rating is not finite, or its force rate takes longer than 12 ms from the rated force to zero",
        "a rating is explained in framework/device/device_rating.h");
    throw InputError(diagnostics);
  }
  return table;
}

}  // namespace presa
