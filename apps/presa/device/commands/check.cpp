#include <cstdio>
#include <memory>

#include "apps/common/terminal/status_line.h"
#include "apps/presa/device/commands/device_commands.h"
#include "apps/presa/device/findings.h"
#include "framework/scene/load.h"

namespace presa {
namespace {

int checkRig(const std::string& file, const std::string& format) {
  Diagnostics diagnostics;
  const Rig rig = loadRig(file, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  std::vector<device::Report> reports;
  for (const DeviceBinding& binding : rig.devices) {
    reports.push_back(device::ask(binding));
    reports.back().name = binding.role;
    reports.back().summary = binding.driver;
  }
  std::fputs((format == "json" ? device::json(reports) : device::text(reports, wantsColor(stdout))).c_str(), stdout);
  return device::hasProblem(reports) ? kExitFault : kExitOk;
}

}  // namespace

void addDeviceCheck(Command app, int& status) {
  auto rig = std::make_shared<std::string>();
  auto format = std::make_shared<std::string>("text");
  Command command = app.command("check", "Whether the devices of a rig are there and ready");
  command.option("RIG", *rig, "rig file").required();
  command.option("--format", *format, "text or json").oneOf({"text", "json"});
  command.footer(
      "No force is sent and no firmware loaded.\n"
      "Exit status: 0 all are ready, 1 something keeps one from being used, 2 bad input.\n"
      "Example:  presa device check config/rigs/pinch_cube.xml");
  command.action([rig, format, &status] { status = checkRig(*rig, *format); });
}

}  // namespace presa
