#pragma once
#include <string>

#include "framework/core/diagnostics/refuse.h"
#include "framework/device/device_plugin.h"
#include "framework/plugin/plugin_loader.h"

namespace presa::device {

enum DriverCode { kNoDriver = 470, kLacks = 471 };

/// The table of this type that a driver exports as `symbol`. Refuses in the user's words: E470 no such driver, E471 it
/// has no such table (`lacks`: "has no figures of its own"), or one of another build.
template <class Table>
const Table& driverTable(const std::string& command, const std::string& driver, const char* symbol,
                         const std::string& lacks) {
  const auto find = [&](const char* name, int code, const std::string& what, const std::string& help) {
    try {
      return pluginSymbol(driver, name);
    } catch (const InputError& error) {
      refuse(code, command, what, help.empty() ? error.diagnostics().all().at(0).help : help);
    }
  };
  find("presaDevicePlugin", kNoDriver, "there is no driver " + quote(driver), "");
  void* found = find(symbol, kLacks, "driver " + quote(driver) + " " + lacks, "percro_arm has");
  const Table& table = *reinterpret_cast<const Table* (*)()>(found)();
  if (table.abi != kPluginAbi) refuse(kLacks, command, "driver " + quote(driver) + " is of another build of Presa");
  return table;
}

}  // namespace presa::device
