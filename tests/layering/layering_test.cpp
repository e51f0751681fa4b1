// These tests read the sources and the binaries and fail when the architecture is broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/layering/rules.h"
#include "tests/layering/source_tree.h"

namespace presa::layering {
namespace {

using testing::IsEmpty;
using testing::IsSupersetOf;

/// Every file that breaks the rule, as "path: finding".
std::vector<std::string> offenders(const std::function<Finding(const SourceFile&)>& rule) {
  std::vector<std::string> found;
  for (const SourceFile& file : sourceTree()) {
    if (const Finding finding = rule(file)) found.push_back(file.path + ": " + *finding);
  }
  return found;
}

// If the walk missed folders, the rules below would be pointless.
TEST(Layering, TheWalkSeesTheWholeTree) {
  std::set<std::string> paths;
  for (const SourceFile& file : sourceTree()) paths.insert(file.path);
  EXPECT_THAT(paths, IsSupersetOf({"CMakeLists.txt", "framework/core/graph/port.h", "apps/presa/main.cpp",
                                   "modules/dynamics_ode/CMakeLists.txt", "tests/layering/layering_test.cpp"}));
}

// An engine that only one folder includes can be replaced.
TEST(Layering, EachOutsideLibraryIsIncludedInOneFolder) { EXPECT_THAT(offenders(includesForeignLibrary), IsEmpty()); }

// Modules and devices are connected only by the graph, so that a run can leave out any of them.
TEST(Layering, IncludesFollowTheArrows) { EXPECT_THAT(offenders(includesAgainstTheArrows), IsEmpty()); }

TEST(Layering, HeadersHavePragmaOnce) { EXPECT_THAT(offenders(lacksPragmaOnce), IsEmpty()); }

TEST(Layering, FilesStayShortEnoughToRead) { EXPECT_THAT(offenders(isTooLong), IsEmpty()); }

// Paths of one machine break every other checkout.
TEST(Layering, NoFileNamesAPathOfOneMachine) { EXPECT_THAT(offenders(namesPathOfOneMachine), IsEmpty()); }

// A change of the wall clock must not affect a run.
TEST(Layering, NothingThatRunsReadsTheWallClock) { EXPECT_THAT(offenders(readsTheWallClock), IsEmpty()); }

// framework/input refuses pipes that block, devices without an end, and files of other folders.
TEST(Layering, FilesFromOutsideComeThroughOneDoor) { EXPECT_THAT(offenders(opensAFileByItself), IsEmpty()); }

// Every room has one README page.
TEST(Layering, EveryRoomSaysWhatItIsFor) {
  std::vector<std::string> silent;
  for (const std::string& room : rooms()) {
    if (room == "docs" || room.starts_with("docs/")) continue;  // pages, no code
    if (!std::filesystem::exists(std::filesystem::path(PRESA_SOURCE_DIR) / room / "README.md")) silent.push_back(room);
  }
  EXPECT_THAT(silent, IsEmpty());
}

// The core stays small enough for the author of a module to read in an afternoon.
TEST(Layering, TheCoreStaysSmall) {
  std::size_t lines = 0;
  for (const SourceFile& file : sourceTree()) {
    if (file.isCpp() && file.path.starts_with("framework/core/")) lines += file.lines();
  }
  EXPECT_GT(lines, 1000U);
  EXPECT_LE(lines, 2300U);
}

// The entries of the root are fixed; files that tools demand there are listed by name.
TEST(Layering, TheRootHoldsNothingElse) {
  std::istringstream names(
      "CMakeLists.txt CMakePresets.json README.md LICENSE CONTRIBUTING.md CHANGELOG.md CITATION.cff dev .ci .gitignore "
      ".clang-format .clang-tidy .editorconfig framework modules devices apps config experiments tests docs");
  const std::set<std::string> allowed(std::istream_iterator<std::string>(names), {});
  std::vector<std::string> others;
  for (const std::string& entry : rootEntries()) {
    if (!allowed.contains(entry)) others.push_back(entry);
  }
  EXPECT_THAT(others, IsEmpty());
}

// A run maps an engine only when its scene needs it: neither the program nor the framework, and no plug-in but the
// engine's own, may be linked with one.
TEST(Layering, OnlyItsOwnPlugInLinksAnEngine) {
  const std::map<std::string, std::set<std::string>> homes_of{
      {"libode", {"presa_dynamics_ode.so"}},   {"libfcl", {"presa_collision_fcl.so"}},
      {"libosg", {"presa_view_osg.so"}},       {"libEGL", {"presa_view_osg.so"}},
      {"libX11", {"presa_view_osg.so"}},       {"libhdf5", {"presa_record.so"}},
      {"libassimp", {"presa_mesh_import.so"}}, {"libmeshoptimizer", {"presa_mesh_decimate.so"}},
      {"libqhull", {"presa_hull.so"}},         {"libcrypto", {"presa_checksum.so"}},
      {"libusb", {"presa_novint_falcon.so"}},  {"libddsc", {"presa_bus_dds.so"}},
      {"libpng", {"presa_texture_image.so"}},  {"libmujoco", {"presa_dynamics_mujoco.so", "presa_robot_reader.so"}},
  };
  const std::filesystem::path build = PRESA_BINARY_DIR;
  std::vector<std::filesystem::path> binaries;
  for (const auto& entry : std::filesystem::directory_iterator(build / "bin")) {
    const std::string name = entry.path().filename().string();
    if (name == "presa" || name.starts_with("presa-")) binaries.push_back(entry.path());
  }
  for (const auto& entry : std::filesystem::directory_iterator(build / "lib/presa")) {
    if (entry.path().extension() != ".xml") binaries.push_back(entry.path());  // not a manifest
  }

  std::vector<std::string> wrong;
  for (const std::filesystem::path& binary : binaries) {
    for (const std::string& library : neededLibraries(binary)) {
      for (const auto& [engine, homes] : homes_of) {
        if (library.starts_with(engine) && !homes.contains(binary.filename().string())) {
          wrong.push_back(binary.filename().string() + " needs " + library);
        }
      }
    }
  }
  EXPECT_THAT(wrong, IsEmpty());
}

// `presa` itself, the most used program, contains nothing of the other uses.
TEST(Layering, TheProgramHoldsNothingOfTheOtherUses) {
  const std::set<std::string> mapped = nameSpaces(std::filesystem::path(PRESA_BINARY_DIR) / "bin/presa");
  EXPECT_TRUE(mapped.contains("terminal")) << "the names of the program's functions were not read";
  for (const char* use :
       {"temple", "experiment", "cost", "stability", "lectures", "printed", "faults", "psychophysics", "statistics"}) {
    EXPECT_FALSE(mapped.contains(use)) << use;
  }
}

}  // namespace
}  // namespace presa::layering
