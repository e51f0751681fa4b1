#include "devices/novint_falcon/diagnose.h"

#include "devices/novint_falcon/codes.h"
#include "devices/novint_falcon/falcon_device.h"
#include "devices/novint_falcon/firmware.h"
#include "devices/novint_falcon/usb_transport.h"
#include "framework/core/schedule/clock.h"
#include "framework/input/folders.h"

namespace presa::falcon {
namespace {

using Verdict = DeviceFinding::Verdict;

constexpr double kPatience = 5;          // [s] to wait for a verdict; on an idle machine it takes half a second
constexpr std::int64_t kStep = 500'000;  // [ns]

/// Asks a device for its state, with requests of zero force.
LinkStatus ask(FalconTransport& transport) {
  FalconLink link(transport, {}, {});
  const std::int64_t start = monotonicNs();
  double now = 0;
  link.open(now);
  const auto settled = [&] {
    const LinkStatus status = link.status();
    return status.state == LinkState::kDead || status.replies >= FalconLink::kHomedInARow;
  };
  for (std::int64_t wake = start; now < kPatience && !settled();) {
    sleepUntilNs(wake += kStep);
    now = static_cast<double>(monotonicNs() - start) * 1e-9;
    link.step(now, {});
  }
  return link.status();
}

DeviceFinding findingOf(const LinkStatus& status, const std::string& device, bool firmware_named) {
  if (status.state == LinkState::kDead) {
    if (status.fault == LinkFault::kNoFirmware && firmware_named)
      return {Verdict::kFine, 0, device, "no firmware yet: it will be loaded when the device is opened", ""};
    return {Verdict::kProblem, codeOf(status.fault), device, describe(status.fault), remedy(status.fault)};
  }
  if (status.state == LinkState::kStarting)
    return {Verdict::kProblem, kUsbFails, device,
            "its USB transfers take too long: it is not known whether firmware runs",
            "close programs that load this machine, then ask again"};
  if (status.homed != kAllHomed)
    return {Verdict::kWarning, kNotHomed, device, "its firmware runs, but the grip is not homed",
            remedy(LinkFault::kHomingLost)};
  return {Verdict::kFine, 0, device, "its firmware runs, the grip is homed", ""};
}

std::string nameOf(const UsbFalcon& falcon) {
  return (falcon.serial.empty() ? "" : "serial " + falcon.serial + ", ") + "port " + falcon.port;
}

void checkFirmware(const DeviceBinding& binding, std::vector<DeviceFinding>& findings) {
  const auto file = binding.settings.find("firmware");
  if (file == binding.settings.end()) return;
  Diagnostics diagnostics;
  if (input::checkNamed(file->second.where, file->second.value, diagnostics))
    readFirmware(file->second.value, file->second.where, diagnostics);
  for (const Diagnostic& found : diagnostics.all()) {
    const bool error = found.severity == Diagnostic::Severity::kError;
    findings.push_back({error ? Verdict::kProblem : Verdict::kWarning, found.code, "", found.message, found.help});
  }
  if (diagnostics.all().empty()) findings.push_back({Verdict::kFine, 0, "", "the firmware file is a known one", ""});
}

}  // namespace

std::vector<DeviceFinding> diagnose(const DeviceBinding& binding) {
  std::vector<DeviceFinding> findings;
  checkFirmware(binding, findings);
  const auto serial = binding.settings.find("serial");
  const std::string wanted = serial == binding.settings.end() ? "" : serial->second.value;
  UsbFailure failure;
  failure.present = listFalcons(failure);
  if (failure.problem == UsbProblem::kNone && failure.present.empty()) failure.problem = UsbProblem::kNoDevice;
  // without a rig, a missing Falcon is no problem
  if (failure.problem != UsbProblem::kNone)
    findings.push_back({binding.role.empty() ? Verdict::kWarning : Verdict::kProblem, codeOf(failure.problem), "",
                        describe(failure, wanted), remedy(failure)});
  bool found = wanted.empty() || failure.present.empty();
  for (const UsbFalcon& falcon : failure.present) {
    if (!wanted.empty() && falcon.serial != wanted && falcon.port != wanted && !falcon.serial.empty()) continue;
    found = true;
    UsbFailure of_this{falcon.problem, falcon.node, falcon.detail, {}};
    UsbHandle handle = falcon.problem == UsbProblem::kNone ? openFalcon(falcon.port, of_this) : UsbHandle{};
    if (!handle) {
      findings.push_back(
          {Verdict::kProblem, codeOf(of_this.problem), nameOf(falcon), describe(of_this, wanted), remedy(of_this)});
      continue;
    }
    UsbTransport transport(std::move(handle));
    findings.push_back(findingOf(ask(transport), nameOf(falcon), binding.settings.contains("firmware")));
  }
  if (!found) {
    failure.problem = UsbProblem::kNotThisOne;
    findings.push_back({Verdict::kProblem, kWhichFalcon, "", describe(failure, wanted), remedy(failure)});
  }
  return findings;
}

}  // namespace presa::falcon
