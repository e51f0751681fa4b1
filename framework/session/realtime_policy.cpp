#include "framework/session/realtime_policy.h"

#include <algorithm>

#include "framework/core/diagnostics/refuse.h"
#include "framework/device/device_plugin.h"
#include "framework/device/supervision/command_keeper.h"
#include "framework/scene/ages.h"
#include "framework/scene/xml/value_rule.h"
#include "framework/session/session.h"

namespace presa {
namespace {

std::string refusalOf(const RealtimeRights& rights) {
  std::string text;
  if (!rights.fifo.empty()) text = "SCHED_FIFO is refused (" + rights.fifo + ")";
  if (!rights.memory.empty())
    text += std::string(text.empty() ? "" : ", ") + "memory cannot be locked (" + rights.memory + ")";
  return text;
}

bool isHardware(const PlannedDevice& device) {
  try {
    return devicePlugin(device.driver).hardware;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

bool drivesHardware(const std::vector<PlannedDevice>& devices) {
  return std::any_of(devices.begin(), devices.end(), isHardware);
}

void checkCommandRate(const Scene& scene, const Rig& rig, const Plan& plan, Diagnostics& diagnostics) {
  const double lowest = ages::kPeriods / CommandKeeper::kHold;
  if (scene.rates.haptic >= lowest) return;
  for (const DeviceBinding& binding : rig.devices) {
    const auto planned = std::find_if(plan.devices.begin(), plan.devices.end(),
                                      [&](const PlannedDevice& device) { return device.role == binding.role; });
    if (planned == plan.devices.end() || !isHardware(*planned)) continue;
    diagnostics.error(410, binding.where,
                      "the force of '" + binding.role + "' would repeatedly go to zero: its driver '" + binding.driver +
                          "' takes a force away after " + xml::numberText(1e3 * CommandKeeper::kHold) +
                          " ms without a command, and the haptic rate is " + xml::numberText(scene.rates.haptic) +
                          " Hz",
                      "rates/haptic=\"" + xml::numberText(lowest) + "\" or more");
  }
}

double forceShare(bool hardware, const RunOptions& options, const RealtimeProbe& probe,
                  std::vector<std::string>& notes) {
  if (!hardware || !options.realtime) return 1;
  const RealtimeRights rights = probe();
  if (rights.granted()) return 1;
  const std::string refused = refusalOf(rights);
  if (!options.allow_no_rt) {
    refuse(
        463, "", refused + ": other programs could delay the control of a device that is pushing a hand",
        "write '@plugdev - rtprio 95' and '@plugdev - memlock unlimited' to /etc/security/limits.d/presa.conf, and log "
        "in again ('ulimit -r', 'ulimit -l' show it); `presa run --allow-no-rt` goes on with half the force, an "
        "experiment does not");
  }
  notes.push_back(refused + ", as allowed: every force limit is halved");
  return kShareWithoutRights;
}

}  // namespace presa
