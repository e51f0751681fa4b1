#include "modules/bus_dds/security.h"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <string>

#include "framework/core/diagnostics/refuse.h"

namespace presa::bus_dds {
namespace {

/// Path of a security plug-in. Debian installs them in a folder beside the library that the loader does not search.
std::string pluginFile(const std::string& name) {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_domain), &library) == 0 || library.dli_fname == nullptr)
    refuse(756, "bus", "cannot tell where Cyclone DDS is installed");
  const std::filesystem::path folder = std::filesystem::canonical(library.dli_fname).parent_path();
  const std::string file = "libdds_security_" + name + ".so";
  for (const std::filesystem::path& candidate : {folder / "libddsc0debian" / file, folder / file})
    if (std::filesystem::exists(candidate)) return candidate.string();
  refuse(756, "bus", "Cyclone DDS is installed without its security plug-in " + file,
         "Debian 12's package libddsc0debian has it, in " + (folder / "libddsc0debian").string());
}

}  // namespace

Qos securityQos(const bus::KeyFiles& keys) {
  Qos qos(dds_create_qos());
  const auto set = [&](const std::string& name, const std::string& value) {
    dds_qset_prop(qos.get(), ("dds.sec." + name).c_str(), value.c_str());
  };
  struct Plugin {
    const char *property, *library, *function;
  };
  for (const Plugin& plugin : {Plugin{"auth", "auth", "authentication"}, Plugin{"access", "ac", "access_control"},
                               Plugin{"crypto", "crypto", "crypto"}}) {
    const std::string library = std::string(plugin.property) + ".library.";
    set(library + "path", pluginFile(plugin.library));
    set(library + "init", std::string("init_") + plugin.function);
    set(library + "finalize", std::string("finalize_") + plugin.function);
  }
  set("auth.identity_ca", "file:" + keys.authority);
  set("auth.identity_certificate", "file:" + keys.certificate);
  set("auth.private_key", "file:" + keys.key);
  set("access.permissions_ca", "file:" + keys.authority);
  set("access.governance", "file:" + keys.governance);
  set("access.permissions", "file:" + keys.permissions);
  return qos;
}

}  // namespace presa::bus_dds
