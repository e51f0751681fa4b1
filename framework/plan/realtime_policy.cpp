#include "framework/plan/realtime_policy.h"

#include <algorithm>

#include "framework/diagnostics/refuse.h"
#include "framework/plan/plugin.h"
#include "framework/plan/session.h"

namespace presa {
namespace {

std::string refusalOf(const RealtimeRights& rights) {
  std::string text;
  if (!rights.fifo.empty()) text = "SCHED_FIFO is refused (" + rights.fifo + ")";
  if (!rights.memory.empty())
    text += std::string(text.empty() ? "" : ", ") + "memory cannot be locked (" + rights.memory + ")";
  return text;
}

}  // namespace

bool drivesHardware(const Plan& plan) {
  return std::any_of(plan.devices.begin(), plan.devices.end(), [](const PlannedDevice& device) {
    try {
      return devicePlugin(device.driver).hardware;
    } catch (const InputError&) {
      return false;
    }
  });
}

double forceShare(bool hardware, const RunOptions& options, const RealtimeProbe& probe,
                  std::vector<std::string>& notes) {
  if (!hardware || !options.realtime) return 1;
  const RealtimeRights rights = probe();
  if (rights.granted()) return 1;
  const std::string refused = refusalOf(rights);
  if (!options.allow_no_rt) {
    refuse(463, "", refused + ": other programs could hold up a device that is pushing a hand",
           "let your group have it in /etc/security/limits.conf, '@plugdev - rtprio 90' and '@plugdev - memlock "
           "unlimited', and log "
           "in again ('ulimit -r', 'ulimit -l' show it); `presa run --allow-no-rt` goes on with half the force, an "
           "experiment does not");
  }
  notes.push_back(refused + ", as allowed: every force limit is halved");
  return kShareWithoutRights;
}

}  // namespace presa
