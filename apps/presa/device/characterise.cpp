#include "apps/presa/device/characterise.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/terminal/status_line.h"
#include "apps/presa/device/driver_symbol.h"

namespace presa::device {
namespace {

void claim(const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed || !std::ofstream(folder + "/characteristics.json", std::ios::app))
    refuse(472, "--out " + folder, "nothing can be written there",
           failed ? failed.message() : "the folder is not writable");
}

}  // namespace

int characterise(const CharacteriseOptions& options) {
  const auto& driver = driverTable<CharacterisationPlugin>("presa device characterise", options.driver,
                                                           kCharacterisationSymbol, "has no figures of its own");
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
