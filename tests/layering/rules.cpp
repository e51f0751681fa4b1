#include "tests/layering/rules.h"

#include <algorithm>
#include <array>
#include <regex>
#include <set>
#include <vector>

namespace presa::layering {
namespace {

constexpr std::size_t kMaxLines = 800;
constexpr std::size_t kMaxReadmeLines = 40;
constexpr std::size_t kMaxLongReadmeLines = 140;  // the root's README, and config's reference of the scene format

struct Library {
  const char* headers;  ///< regular expression for the included name
  const char* home;     ///< a folder that may include it
};

// tests may include any library, as an independent oracle
constexpr std::array kLibraries{
    Library{"ode/.*", "modules/dynamics_ode/"},
    Library{"mujoco/.*", "modules/dynamics_mujoco/"},
    Library{"mujoco/.*", "apps/robot_reader/"},
    Library{"bt[A-Z].*|Bullet.*|LinearMath/.*", "modules/dynamics_bullet/"},
    Library{"(fcl|ccd|octomap)/.*", "modules/collision_fcl/"},
    Library{"(osg[A-Za-z]*|OpenThreads|EGL|X11|GL|GLES[23]?)/.*", "modules/view_osg/"},
    Library{"(hdf5|H5).*", "framework/record/record_plugin/"},
    Library{"openssl/.*", "framework/record/checksum/checksum_plugin/"},
    Library{"(dds/.*|RunState\\.h)", "modules/bus_dds/"},
    Library{"libxml/.*", "framework/scene/xml/"},
    Library{"(libpng16/)?png(conf|libconf)?\\.h", "modules/texture_image/"},
    Library{"(libusb-1.0/)?libusb\\.h", "devices/novint_falcon/"},
    Library{"assimp/.*", "framework/geometry/mesh_import_plugin/"},
    Library{"libqhull.*", "framework/grasp/hull_plugin/"},
    Library{"meshoptimizer.*", "framework/geometry/mesh_decimate_plugin/"},
    Library{"CLI/.*", "apps/common/options/"},
    Library{"nlohmann/.*", "apps/"},
    Library{"(pybind11/.*|Python\\.h)", "apps/python/"},
    Library{"boost/math/.*", "experiments/runner/statistics/"},
    Library{"(gtest|gmock|benchmark|rapidcheck)[./].*", "tests/"},
};

/// Folders that the files below `from` may include, beside `from` itself. The longest `from` that matches a file
/// counts.
struct Arrows {
  const char* from;
  std::vector<std::string> to;
};

const std::vector<Arrows>& arrows() {
  static const std::vector<Arrows> kArrows{
      {"framework/core/", {}},
      {"framework/plugin/", {"framework/core/"}},
      {"framework/input/", {"framework/core/"}},
      {"framework/sound/", {"framework/core/", "framework/input/"}},
      {"framework/geometry/", {"framework/core/", "framework/plugin/", "framework/input/"}},
      {"framework/grasp/", {"framework/core/", "framework/plugin/"}},
      {"framework/scene/", {"framework/core/", "framework/plugin/", "framework/input/", "framework/geometry/"}},
      {"framework/haptics/", {"framework/core/", "framework/plugin/", "framework/geometry/", "framework/scene/"}},
      {"framework/assembly/", {"framework/core/", "framework/scene/"}},
      {"framework/device/", {"framework/core/", "framework/plugin/", "framework/scene/"}},
      {"framework/record/", {"framework/core/", "framework/plugin/", "framework/input/", "framework/scene/"}},
      {"framework/bus/",
       {"framework/core/", "framework/plugin/", "framework/input/", "framework/scene/", "framework/device/",
        "framework/record/", "framework/assembly/"}},
      {"framework/walls/", {"framework/core/", "framework/scene/", "framework/device/", "framework/bus/"}},
      {"framework/session/",
       {"framework/core/", "framework/plugin/", "framework/input/", "framework/scene/", "framework/assembly/",
        "framework/device/", "framework/haptics/", "framework/record/", "framework/walls/", "framework/sound/"}},
      {"modules/", {"framework/"}},
      {"devices/", {"framework/", "devices/hand/"}},
      // a model of a device implements the narrow interface of the device's driver
      {"devices/falcon_model/", {"framework/", "devices/hand/", "devices/novint_falcon/transport.h"}},
      {"experiments/runner/", {"framework/"}},
      // methods are plug-ins; they know the contract of methods alone
      {"experiments/methods/", {"framework/", "experiments/runner/psychophysics/"}},
      {"experiments/study/", {"framework/"}},
      {"experiments/stability/", {"framework/", "experiments/study/"}},
      // fault rehearsals use the driver and a model of its device
      {"experiments/faults/", {"framework/", "experiments/study/", "devices/novint_falcon/", "devices/falcon_model/"}},
      {"apps/common/", {"framework/"}},
      {"apps/presa/", {"framework/", "devices/", "apps/common/", "apps/robot_reader/"}},
      {"apps/robot_reader/", {"framework/"}},
      {"apps/experiment/", {"framework/", "experiments/runner/", "apps/common/"}},
      {"apps/temple/", {"framework/", "experiments/study/", "apps/common/"}},
      {"apps/studies/", {"framework/", "experiments/", "apps/common/"}},
      {"apps/supervisor/", {"framework/"}},
      {"apps/python/", {"framework/"}},
      {"tests/", {"framework/", "modules/", "devices/", "experiments/", "apps/"}},
  };
  return kArrows;
}

/// The folder that a file may always include. For modules, devices and studies it is their own folder only.
std::string ownRoom(const Arrows& arrows, const SourceFile& file) {
  const std::string from = arrows.from;
  return from == "modules/" || from == "devices/" || from == "apps/studies/" ? file.part() + "/" : from;
}

}  // namespace

Finding includesForeignLibrary(const SourceFile& file) {
  if (!file.isCpp() || file.topFolder() == "tests") return {};
  for (const std::string& name : file.includes()) {
    std::string homes;  // that the file is not in
    for (const Library& library : kLibraries) {
      if (!std::regex_match(name, std::regex(library.headers))) continue;
      homes += (homes.empty() ? "" : ", ") + std::string(library.home);
      if (file.path.starts_with(library.home)) {
        homes.clear();
        break;
      }
    }
    if (!homes.empty()) return "includes <" + name + ">, which belongs to " + homes;
  }
  return {};
}

Finding includesAgainstTheArrows(const SourceFile& file) {
  static const std::regex kOurs("(framework|modules|devices|experiments|apps|tests)/.*");
  if (!file.isCpp() || !std::regex_match(file.path, kOurs)) return {};
  const Arrows* longest = nullptr;
  for (const Arrows& candidate : arrows()) {
    const std::string from = candidate.from;
    if (file.path.starts_with(from) && (longest == nullptr || from.size() > std::string(longest->from).size()))
      longest = &candidate;
  }
  if (longest == nullptr) return "is in a room that tests/layering/rules.cpp has no arrows for";
  for (const std::string& name : file.includes()) {
    if (!std::regex_match(name, kOurs) || name.starts_with(ownRoom(*longest, file))) continue;
    if (std::ranges::none_of(longest->to, [&](const std::string& to) { return name.starts_with(to); }))
      return "includes \"" + name + "\", which " + longest->from + " may not know";
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
  // a path begins after a blank, quote or bracket, so that "network/" or a URL does not match
  static const std::regex kPath(R"((?:^|[\s"'(<=:])(/(?:work|home|root|Users)/[\w.]))");
  std::smatch match;
  if (!file.isText() || !std::regex_search(file.text, match, kPath)) return {};
  return "names a path of one machine: " + match[1].str() + "…";
}

Finding readsTheWallClock(const SourceFile& file) {
  static const std::regex kClock(R"(CLOCK_REALTIME|system_clock|gettimeofday|\b(std::|::)?time\((nullptr|NULL|0\)|&))");
  const std::string top = file.topFolder();
  const bool runs = top == "framework" || top == "modules" || top == "devices";
  // exception: a recording stores its date
  if (!runs || !file.isCpp() || file.path == "framework/record/record_plugin/recording_file.cpp") return {};
  std::smatch match;
  if (!std::regex_search(file.text, match, kClock)) return {};
  return "reads the wall clock: " + match[0].str();
}

Finding opensAFileByItself(const SourceFile& file) {
  static const std::regex kOpens(R"(\bifstream\b|\bfopen\(|\bfreopen\(|xmlReadFile|xmlParseFile|H5Fopen)");
  static const std::set<std::string> kOwn{
      "framework/geometry/mesh_import_plugin/isolation.cpp",
      "framework/session/haptic_processor.cpp",
      "apps/presa/explain/description.cpp",
      "apps/common/machine.cpp",
      "apps/studies/faults/periods.cpp",
      "apps/studies/cost/measure.cpp",
      "framework/record/record_plugin/open_file.cpp"};  // HDF5 opens files itself, after a check
  const std::string top = file.topFolder();
  const bool reads = top == "framework" || top == "modules" || top == "devices" || top == "apps";
  std::smatch match;
  if (!reads || !file.isCpp() || kOwn.contains(file.path) || !std::regex_search(file.text, match, kOpens)) return {};
  return "opens a file by itself: " + match[0].str();
}

}  // namespace presa::layering
