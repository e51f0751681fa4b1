#include "apps/presa/device/characterise.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "apps/presa/atomic_file.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/terminal/status_line.h"
#include "framework/diagnostics/refuse.h"
#include "framework/plan/plugin_loader.h"

namespace presa::device {
namespace {

constexpr const char* kWhere = "presa device characterise";

/// The plug-in's symbol, or a refusal in the user's words; an empty help: the loader's.
void* symbolOf(const std::string& driver, const char* symbol, int code, const std::string& what,
               const std::string& help) {
  try {
    return pluginSymbol(driver, symbol);
  } catch (const InputError& error) {
    refuse(code, kWhere, what, help.empty() ? error.diagnostics().all().at(0).help : help);
  }
}

const CharacterisationPlugin& figuresOf(const std::string& driver) {
  symbolOf(driver, "presaDevicePlugin", 470, "there is no driver " + quote(driver), "");
  using Table = const CharacterisationPlugin* (*)();
  const auto table =
      reinterpret_cast<Table>(symbolOf(driver, kCharacterisationSymbol, 471,
                                       "driver " + quote(driver) + " has no figures of its own", "percro_arm has"));
  if (table()->abi != kPluginAbi) refuse(471, kWhere, "driver " + quote(driver) + " is of another build of Presa");
  return *table();
}

void claim(const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed || !std::ofstream(folder + "/characteristics.json", std::ios::app))
    refuse(472, "--out " + folder, "nothing can be written there",
           failed ? failed.message() : "the folder is not writable");
}

}  // namespace

int characterise(const CharacteriseOptions& options) {
  const CharacterisationPlugin& driver = figuresOf(options.driver);
  if (!options.out.empty()) claim(options.out);
  const Characterisation found = driver.make();
  if (!options.out.empty()) {
    writeFileAtomically(options.out + "/characteristics.json", json(found));
    writeFileAtomically(options.out + "/report.html", page(found));
  }
  std::fputs((options.format == "json" ? json(found) : table(found, wantsColor(stdout))).c_str(), stdout);
  if (!options.out.empty() && options.format != "json")
    std::printf("Report: %s/report.html   figures: %s/characteristics.json\n", options.out.c_str(),
                options.out.c_str());
  const bool all = std::all_of(found.figures.begin(), found.figures.end(),
                               [](const Characteristic& f) { return !f.compared() || f.agrees(); });
  return all ? kExitOk : kExitFault;
}

}  // namespace presa::device
