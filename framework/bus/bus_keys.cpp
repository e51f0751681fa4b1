#include "framework/bus/bus_keys.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "framework/core/diagnostics/refuse.h"
#include "framework/record/checksum/certify.h"

namespace presa::bus {
namespace {

namespace fs = std::filesystem;
constexpr int kDays = 3650;

/// A role of a process on the bus, and the topics of modules/bus_dds that it may use.
struct Part {
  std::string name;
  std::vector<std::string> publishes, subscribes;
};

std::vector<Part> parts() {
  const std::vector<std::string> state{"presa_object_state", "presa_device_state", "presa_beat",
                                       "presa_event",        "presa_scene",        "presa_frame_state"};
  const std::vector<std::string> walls{"presa_wall_frame", "presa_wall_drawn"};  // of viewers that form a CAVE
  const auto with = [](std::vector<std::string> topics, std::initializer_list<const char*> more) {
    topics.insert(topics.end(), more.begin(), more.end());
    return topics;
  };
  return {{"run",
           with(state, {"presa_answer", "presa_parameter", "presa_guide_status"}),
           {"presa_command", "presa_guide_order"}},
          {"viewer", walls, with(state, {"presa_wall_frame", "presa_wall_drawn"})},
          {"guide", with(walls, {"presa_guide_order"}),
           with(state, {"presa_wall_frame", "presa_wall_drawn", "presa_guide_status"})},
          {"commander", {"presa_command"}, with(state, {"presa_answer", "presa_parameter"})}};
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">\n";
}

const std::string kHead =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">\n";
const std::string kDomains = "<domains><id_range><min>0</min><max>230</max></id_range></domains>\n";

/// DDS security governance: all topics and discovery are encrypted, and participants without a certificate are refused.
std::string governance() {
  const std::string topic =
      element("topic_expression", "*") + element("enable_discovery_protection", "true") +
      element("enable_liveliness_protection", "true") + element("enable_read_access_control", "true") +
      element("enable_write_access_control", "true") + element("metadata_protection_kind", "ENCRYPT") +
      element("data_protection_kind", "NONE");  // the submessages are encrypted already
  const std::string rule = kDomains + element("allow_unauthenticated_participants", "false") +
                           element("enable_join_access_control", "true") +
                           element("discovery_protection_kind", "ENCRYPT") +
                           element("liveliness_protection_kind", "ENCRYPT") + element("rtps_protection_kind", "NONE") +
                           element("topic_access_rules", element("topic_rule", topic));
  return kHead + element("domain_access_rules", element("domain_rule", rule)) + "</dds>\n";
}

std::string topicsOf(const char* verb, const std::vector<std::string>& topics) {
  if (topics.empty()) return {};
  std::string names;
  for (const std::string& topic : topics) names += element("topic", topic);
  return element(verb, element("topics", names));
}

std::string permissions(const Part& part, const std::string& subject) {
  return kHead + "<permissions><grant name=\"" + part.name + "\">\n" + element("subject_name", "CN=" + subject) +
         // the certificate, which is also required, expires earlier
         element("validity",
                 element("not_before", "2020-01-01T00:00:00") + element("not_after", "2100-01-01T00:00:00")) +
         element("allow_rule",
                 kDomains + topicsOf("publish", part.publishes) + topicsOf("subscribe", part.subscribes)) +
         element("default", "DENY") + "</grant></permissions>\n</dds>\n";
}

[[noreturn]] void fail(const std::string& file) {
  refuse(754, file, std::string("cannot be written: ") + std::strerror(errno));
}

void makeFolder(const fs::path& folder) {
  if (mkdir(folder.c_str(), 0700) != 0) fail(folder.string());
}

/// Writes a file that is private to the owner from its creation on.
void write(const fs::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) fail(file.string());
  const bool written = ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (fsync(descriptor) != 0 || close(descriptor) != 0 || !written) fail(file.string());
}

KeyFiles filesIn(const fs::path& folder) {
  return {(folder / "authority.pem").string(), (folder / "certificate.pem").string(), (folder / "key.pem").string(),
          (folder / "governance.p7s").string(), (folder / "permissions.p7s").string()};
}

}  // namespace

KeyFiles checkedKeys(const std::string& folder) {
  std::error_code unknown;
  const fs::path full = fs::absolute(folder, unknown);
  KeyFiles files = filesIn(full);
  Diagnostics diagnostics;
  for (const std::string* file :
       {&files.authority, &files.certificate, &files.key, &files.governance, &files.permissions}) {
    struct stat status {};
    if (stat(file->c_str(), &status) != 0 || !S_ISREG(status.st_mode)) {
      diagnostics.error(
          753, {*file, 0, 0}, "no such file; it is part of the keys for the bus",
          "presa bus keys DIR makes them; --bus-keys takes one part: DIR/run, DIR/viewer, DIR/guide or DIR/commander");
    } else if (file == &files.key && (status.st_mode & 077U) != 0) {
      diagnostics.error(753, {*file, 0, 0}, "others on this machine may read the private key", "run chmod 600 on it");
    }
  }
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  return files;
}

void makeKeys(const std::string& folder) {
  if (fs::exists(folder))
    refuse(754, folder, "exists already; keys are never overwritten", "name a folder that does not exist");
  const Certificate authority = certifyPlugin().authority("presa authority", kDays);
  const fs::path root(folder);
  makeFolder(root);
  makeFolder(root / "authority");
  write(root / "authority" / "authority.pem", authority.certificate);
  write(root / "authority" / "key.pem", authority.key);
  const std::string rules = certifyPlugin().sign(authority, governance());
  for (const Part& part : parts()) {
    const std::string subject = "presa-" + part.name;
    const Certificate own = certifyPlugin().certify(authority, subject, kDays);
    makeFolder(root / part.name);
    const KeyFiles files = filesIn(root / part.name);
    write(files.authority, authority.certificate);
    write(files.certificate, own.certificate);
    write(files.key, own.key);
    write(files.governance, rules);
    write(files.permissions, certifyPlugin().sign(authority, permissions(part, subject)));
  }
}

void requireKeysForCommands(const BusSettings& settings) {
  if (!settings.network.starts_with("lan") || !settings.keys.empty()) return;
  refuse(752, "bus",
         "commands on network '" + settings.network + "' need keys: without them anyone on it could send commands",
         "presa bus keys DIR makes them; then --bus-keys DIR/run here and --bus-keys DIR/commander for presa bus set");
}

}  // namespace presa::bus
