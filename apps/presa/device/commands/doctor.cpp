#include "apps/presa/device/doctor.h"

#include <cstdio>
#include <memory>

#include "apps/common/terminal/status_line.h"
#include "apps/presa/device/commands/device_commands.h"

namespace presa {
namespace {

struct DoctorArguments {
  bool install = false;
  std::string udev = "/etc/udev/rules.d", format = "text";
};

int doctor(const DoctorArguments& arguments) {
  const std::vector<std::string> drivers = device::drivers();
  if (arguments.install) {
    for (const std::string& file : device::installUdevRules(drivers, arguments.udev))
      std::fprintf(stderr, "written: %s; plug the device in again\n", file.c_str());
  }
  std::vector<device::Report> reports{device::computer(drivers, arguments.udev)};
  for (const std::string& name : drivers) {
    DeviceBinding binding;
    binding.driver = name;
    reports.push_back(device::ask(binding));
  }
  std::fputs((arguments.format == "json" ? device::json(reports) : device::text(reports, wantsColor(stdout))).c_str(),
             stdout);
  return device::hasProblem(reports) ? kExitFault : kExitOk;
}

}  // namespace

void addDeviceDoctor(Command app, int& status) {
  auto arguments = std::make_shared<DoctorArguments>();
  Command command = app.command("doctor", "What this computer and its devices lack for real time, with remedies");
  command.flag("--install-udev", arguments->install, "write the rules that let users open devices (as root)");
  command.option("--udev-folder", arguments->udev, "where these rules stand").showDefault();
  command.option("--format", arguments->format, "text or json").oneOf({"text", "json"});
  command.footer(
      "Exit status: 0 no problem (there may be warnings), 1 a problem, 2 the rules cannot be written.\n"
      "Example:  sudo presa device doctor --install-udev");
  command.action([arguments, &status] { status = doctor(*arguments); });
}

}  // namespace presa
