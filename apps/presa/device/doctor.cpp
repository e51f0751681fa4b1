#include "apps/presa/device/doctor.h"

#include <grp.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "apps/common/atomic_file.h"
#include "apps/common/file_text.h"
#include "apps/common/terminal/text.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/session/haptic_processor.h"
#include "framework/session/realtime_rights.h"
#include "framework/session/session.h"

namespace presa::device {
namespace {

using Verdict = DeviceFinding::Verdict;

constexpr const char* kLimits =
    "write '@plugdev - rtprio 95' and '@plugdev - memlock unlimited' to "
    "/etc/security/limits.d/presa.conf, then log in again";
constexpr const char* kGroup = "plugdev";  // group that may open USB devices on Debian; the drivers' rules use it

DeviceFinding findingOf(const std::string& refused, const std::string& what, const std::string& consequence) {
  if (refused.empty()) return {Verdict::kFine, 0, "", what + " is allowed", ""};
  return {Verdict::kWarning, 0, "", what + " is refused (" + refused + "): " + consequence, kLimits};
}

/// Where SCHED_FIFO is allowed.
DeviceFinding processorFinding() {
  const HapticProcessor kept;
  if (kept.number() >= 0)
    return {Verdict::kFine, 0, "", terminal::format("processor %d is free for the haptic thread", kept.number()), ""};
  return {Verdict::kWarning, 0, "", "no processor is free for the haptic thread: drawing may delay it",
          "this process may use only one, or other runs keep them all"};
}

bool inGroup(const char* name) {
  const group* wanted = getgrnam(name);
  if (wanted == nullptr) return false;
  std::vector<gid_t> groups(static_cast<std::size_t>(std::max(0, getgroups(0, nullptr))));
  groups.resize(static_cast<std::size_t>(std::max(0, getgroups(static_cast<int>(groups.size()), groups.data()))));
  return getegid() == wanted->gr_gid || std::find(groups.begin(), groups.end(), wanted->gr_gid) != groups.end();
}

struct Rule {
  std::string driver, file, line;
};

/// The udev rules of the drivers that have one and can be loaded.
std::vector<Rule> rulesOf(const std::vector<std::string>& of_drivers, const std::string& folder) {
  std::vector<Rule> rules;
  for (const std::string& name : of_drivers) {
    try {
      if (const char* line = devicePlugin(name).udev_rule)
        rules.push_back({name, terminal::format("%s/60-presa-%s.rules", folder.c_str(), name.c_str()), line});
    } catch (const InputError&) {  // reported among the findings of the driver
    }
  }
  return rules;
}

}  // namespace

Report computer(const std::vector<std::string>& of_drivers, const std::string& udev_folder) {
  Report report{"this computer", "", {}};
  const RealtimeRights rights = realtimeRights();
  report.findings.push_back(
      findingOf(rights.fifo, "real-time priority (SCHED_FIFO)", "other programs may delay the haptic thread"));
  if (rights.fifo.empty()) report.findings.push_back(processorFinding());
  report.findings.push_back(findingOf(rights.memory, "locked memory", "a page fault may delay a tick"));
  const std::vector<Rule> rules = rulesOf(of_drivers, udev_folder);
  if (!rules.empty() && geteuid() != 0 && !inGroup(kGroup))
    report.findings.push_back({Verdict::kWarning, 0, "", std::string("you are not in the group ") + kGroup,
                               std::string("sudo usermod -aG ") + kGroup + " $USER, then log in again"});
  for (const Rule& rule : rules) {
    if (contentsOf(rule.file).find(rule.line) != std::string::npos)
      report.findings.push_back({Verdict::kFine, 0, "", "the udev rule of " + rule.driver + " is installed", ""});
    else
      report.findings.push_back({Verdict::kWarning, 0, "",
                                 "there is no udev rule of " + rule.driver + " in " + udev_folder,
                                 "sudo presa device doctor --install-udev"});
  }
  return report;
}

std::vector<std::string> installUdevRules(const std::vector<std::string>& of_drivers, const std::string& udev_folder) {
  std::vector<std::string> files;
  for (const Rule& rule : rulesOf(of_drivers, udev_folder)) {
    try {
      writeFileAtomically(rule.file, "# lets the group " + std::string(kGroup) +
                                         " open it; written by presa device doctor\n" + rule.line + "\n");
    } catch (const std::system_error& error) {
      refuse(477, rule.file, std::string("the udev rule cannot be written: ") + error.what(),
             "sudo presa device doctor --install-udev");
    }
    files.push_back(rule.file);
  }
  return files;
}

}  // namespace presa::device
