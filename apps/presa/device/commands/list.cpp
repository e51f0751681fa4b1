#include <cstdio>
#include <memory>

#include "apps/common/terminal/status_line.h"
#include "apps/presa/device/commands/device_commands.h"
#include "apps/presa/device/findings.h"

namespace presa {
namespace {

int list(const std::vector<std::string>& names, const std::string& format) {
  std::vector<device::Report> reports;
  for (const std::string& name : names.empty() ? device::drivers() : names) {
    DeviceBinding binding;
    binding.driver = name;
    reports.push_back(device::ask(binding));
  }
  std::fputs((format == "json" ? device::json(reports) : device::text(reports, wantsColor(stdout))).c_str(), stdout);
  return kExitOk;
}

}  // namespace

void addDeviceList(Command app, int& status) {
  auto names = std::make_shared<std::vector<std::string>>();
  auto format = std::make_shared<std::string>("text");
  Command command = app.command("list", "Drivers, and the devices of each that are plugged in");
  command.option("DRIVER", *names, "only these");
  command.option("--format", *format, "text or json").oneOf({"text", "json"});
  command.footer("Exit status: 0.\nExample:  presa device list novint_falcon");
  command.action([names, format, &status] { status = list(*names, *format); });
}

}  // namespace presa
