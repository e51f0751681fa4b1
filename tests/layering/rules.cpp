#include "tests/layering/rules.h"

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <set>

namespace presa::layering {
namespace {

constexpr std::size_t kMaxLines = 800;
constexpr std::size_t kMaxReadmeLines = 40;
constexpr std::size_t kMaxLongReadmeLines = 140;  // the root's, and config's reference of the scene format

struct Library {
  const char* headers;  ///< regular expression over the included name
  const char* home;     ///< the one folder that may include it
};

// tests may include a library beside its home: as an independent oracle
constexpr std::array kLibraries{
    Library{"ode/.*", "modules/dynamics_ode/"},
    Library{"mujoco/.*", "modules/dynamics_mujoco/"},
    Library{"bt[A-Z].*|Bullet.*|LinearMath/.*", "modules/dynamics_bullet/"},
    Library{"(fcl|ccd|octomap)/.*", "modules/collision_fcl/"},
    Library{"(osg[A-Za-z]*|OpenThreads|EGL|X11|GL|GLES[23]?)/.*", "modules/view_osg/"},
    Library{"(hdf5|H5).*", "framework/record/record_plugin/"},
    Library{"openssl/.*", "framework/record/checksum/checksum_plugin/"},
    Library{"(dds/.*|RunState\\.h)", "modules/bus_dds/"},
    Library{"libxml/.*", "framework/scene/xml/"},
    Library{"(libusb-1.0/)?libusb\\.h", "devices/novint_falcon/"},
    Library{"assimp/.*", "framework/geometry/mesh_import_plugin/"},
    Library{"meshoptimizer.*", "framework/geometry/mesh_decimate_plugin/"},
    Library{"(CLI|nlohmann)/.*", "apps/"},
    Library{"boost/math/.*", "experiments/runner/statistics/"},
    Library{"(gtest|gmock|benchmark|rapidcheck)[./].*", "tests/"},
};

/// Where one part may know of another against the arrows, and what of it.
struct Bridge {
  const char *from, *to;
};
constexpr std::array kBridges{
    // a model of a device stands behind the narrow interface of the device's driver
    Bridge{"devices/falcon_model/", "devices/novint_falcon/transport.h"},
    // faults are rehearsed on the driver and a model of its device
    Bridge{"experiments/faults/", "devices/novint_falcon/"},
    Bridge{"experiments/faults/", "devices/falcon_model/"},
};

bool isBridged(const std::string& from, const std::string& to) {
  return std::ranges::any_of(
      kBridges, [&](const Bridge& bridge) { return from.starts_with(bridge.from) && to.starts_with(bridge.to); });
}

}  // namespace

Finding includesForeignLibrary(const SourceFile& file) {
  if (!file.isCpp() || file.topFolder() == "tests") return {};
  for (const std::string& name : file.includes()) {
    for (const Library& library : kLibraries) {
      if (std::regex_match(name, std::regex(library.headers)) && !file.path.starts_with(library.home)) {
        return "includes <" + name + ">, which belongs to " + library.home;
      }
    }
  }
  return {};
}

Finding includesAgainstTheArrows(const SourceFile& file) {
  // apps -> modules, devices, experiments -> framework; beside that only a part's own headers
  static const std::map<std::string, std::set<std::string>> kMayInclude{
      {"framework", {"framework"}},
      {"modules", {"framework"}},
      {"devices", {"framework"}},
      {"experiments", {"framework"}},
      {"apps", {"framework", "modules", "devices", "experiments", "apps"}},
      {"tests", {"framework", "modules", "devices", "experiments", "apps", "tests"}},
  };
  const auto allowed = kMayInclude.find(file.topFolder());
  if (!file.isCpp() || allowed == kMayInclude.end()) return {};
  for (const std::string& name : file.includes()) {
    const SourceFile included{name, ""};
    if (!kMayInclude.contains(included.topFolder())) continue;  // not one of ours
    if (isBridged(file.path, name)) continue;
    if (!allowed->second.contains(included.topFolder()) && included.part() != file.part()) {
      return "includes \"" + name + "\": " + file.topFolder() + " may not know " + included.part();
    }
  }
  return {};
}

Finding lacksPragmaOnce(const SourceFile& file) {
  if (!file.path.ends_with(".h") || file.text.find("#pragma once\n") != std::string::npos) return {};
  return "has no #pragma once";
}

Finding isTooLong(const SourceFile& file) {
  std::size_t limit = kMaxLines;
  if (file.path.ends_with("README.md")) {
    const bool is_long = file.path == "README.md" || file.path == "config/README.md";
    limit = is_long ? kMaxLongReadmeLines : kMaxReadmeLines;
  }
  if (!file.isText() || file.lines() <= limit) return {};
  return "has " + std::to_string(file.lines()) + " lines, the limit is " + std::to_string(limit);
}

Finding namesPathOfOneMachine(const SourceFile& file) {
  // a path begins after a blank, quote or bracket: "network/" or a URL is none
  static const std::regex kPath(R"((?:^|[\s"'(<=:])(/(?:work|home|root|Users)/[\w.]))");
  std::smatch match;
  if (!file.isText() || !std::regex_search(file.text, match, kPath)) return {};
  return "names a path of one machine: " + match[1].str() + "…";
}

Finding readsTheWallClock(const SourceFile& file) {
  static const std::regex kClock(R"(CLOCK_REALTIME|system_clock|gettimeofday|\b(std::|::)?time\((nullptr|NULL|0\)|&))");
  const std::string top = file.topFolder();
  const bool runs = top == "framework" || top == "modules" || top == "devices";
  // a recording says when it was begun
  if (!runs || !file.isCpp() || file.path == "framework/record/record_plugin/recording_file.cpp") return {};
  std::smatch match;
  if (!std::regex_search(file.text, match, kClock)) return {};
  return "reads the wall clock: " + match[0].str();
}

Finding opensAFileByItself(const SourceFile& file) {
  static const std::regex kOpens(R"(\bifstream\b|\bfopen\(|\bfreopen\(|xmlReadFile|xmlParseFile|H5Fopen)");
  static const std::set<std::string> kOwn{
      "framework/geometry/mesh_import_plugin/isolation.cpp",
      "apps/presa/explain/description.cpp",
      "apps/presa/explain/instruction_counts.cpp",
      "apps/common/machine.cpp",
      "apps/studies/faults/periods.cpp",
      "apps/studies/cost/measure.cpp",
      "framework/record/record_plugin/open_file.cpp"};  // HDF5 has a way of its own, behind the door's look
  const std::string top = file.topFolder();
  const bool reads = top == "framework" || top == "modules" || top == "devices" || top == "apps";
  std::smatch match;
  if (!reads || !file.isCpp() || kOwn.contains(file.path) || !std::regex_search(file.text, match, kOpens)) return {};
  return "opens a file by itself: " + match[0].str();
}

}  // namespace presa::layering
