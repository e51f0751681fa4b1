// Each rule is applied to a file that breaks it and to one that does not.
#include "tests/layering/rules.h"

#include <gtest/gtest.h>

#include <string>

namespace presa::layering {
namespace {

std::string include(const std::string& name) { return "#pragma once\n# include <" + name + ">\n"; }

TEST(LayeringRules, ALibraryHasOneHome) {
  EXPECT_TRUE(includesForeignLibrary({"apps/presa/main.cpp", include("ode/ode.h")}));
  EXPECT_TRUE(includesForeignLibrary({"modules/dynamics_ode/x.cpp", include("fcl/fcl.h")}));
  EXPECT_TRUE(includesForeignLibrary({"framework/record/recording.cpp", include("hdf5.h")}));
  EXPECT_TRUE(includesForeignLibrary({"framework/scene/load.cpp", include("libxml/tree.h")}));
  EXPECT_TRUE(includesForeignLibrary({"framework/session/x.h", include("nlohmann/json.hpp")}));
  EXPECT_TRUE(includesForeignLibrary({"devices/scripted/x.h", include("gtest/gtest.h")}));
  EXPECT_TRUE(includesForeignLibrary({"framework/device/x.h", include("libusb-1.0/libusb.h")}));
  EXPECT_TRUE(includesForeignLibrary({"modules/view_osg/x.h", include("png.h")}));
  EXPECT_TRUE(includesForeignLibrary({"modules/effects/x.h", include("osgViewer/Viewer")}));
  EXPECT_TRUE(includesForeignLibrary({"apps/presa/x.cpp", include("boost/math/distributions/normal.hpp")}));
  EXPECT_FALSE(includesForeignLibrary({"modules/dynamics_ode/x.cpp", include("ode/ode.h")}));
  EXPECT_FALSE(includesForeignLibrary({"framework/core/math/x.h", include("Eigen/Core")}));
}

TEST(LayeringRules, IncludesFollowTheArrows) {
  const auto refused = [](const char* from, const char* to) { return includesAgainstTheArrows({from, include(to)}); };
  EXPECT_TRUE(refused("modules/a/x.cpp", "modules/b/y.h"));
  EXPECT_TRUE(refused("devices/a/x.cpp", "modules/b/y.h"));
  EXPECT_TRUE(refused("devices/a/x.cpp", "devices/b/y.h"));
  EXPECT_FALSE(refused("devices/a/x.cpp", "devices/hand/y.h"));
  EXPECT_FALSE(refused("devices/falcon_model/x.h", "devices/novint_falcon/transport.h"));
  EXPECT_TRUE(refused("devices/falcon_model/x.h", "devices/novint_falcon/packet.h"));
  EXPECT_TRUE(refused("framework/session/x.h", "modules/b/y.h"));
  EXPECT_TRUE(refused("framework/session/x.h", "tests/support/y.h"));
  EXPECT_TRUE(refused("framework/session/x.h", "experiments/study/y.h"));
  EXPECT_TRUE(refused("modules/a/x.cpp", "apps/presa/y.h"));
  EXPECT_FALSE(refused("modules/a/x.cpp", "modules/a/y.h"));
  EXPECT_FALSE(refused("modules/a/deep/x.cpp", "modules/a/y.h"));
}

TEST(LayeringRules, NoArrowRunsUpWithinTheFramework) {
  const auto refused = [](const char* from, const char* to) { return includesAgainstTheArrows({from, include(to)}); };
  EXPECT_TRUE(refused("framework/core/graph/x.h", "framework/scene/y.h"));
  EXPECT_TRUE(refused("framework/scene/x.h", "framework/session/y.h"));
  EXPECT_TRUE(refused("framework/device/supervision/x.h", "framework/session/y.h"));
  EXPECT_TRUE(refused("framework/record/x.h", "framework/session/y.h"));
  EXPECT_FALSE(refused("framework/session/x.h", "framework/record/y.h"));
  EXPECT_FALSE(refused("framework/core/graph/x.h", "framework/core/state/y.h"));
  EXPECT_TRUE(refused("framework/new_room/x.h", "framework/core/state/y.h"));
}

TEST(LayeringRules, UsesDoNotKnowEachOther) {
  const auto refused = [](const char* from, const char* to) { return includesAgainstTheArrows({from, include(to)}); };
  EXPECT_TRUE(refused("apps/common/x.h", "apps/presa/y.h"));
  EXPECT_TRUE(refused("apps/presa/x.h", "apps/temple/y.h"));
  EXPECT_TRUE(refused("apps/temple/x.h", "apps/experiment/y.h"));
  EXPECT_TRUE(refused("apps/presa/x.h", "experiments/runner/y.h"));
  EXPECT_FALSE(refused("apps/experiment/x.h", "apps/common/y.h"));
  EXPECT_FALSE(refused("apps/experiment/x.h", "experiments/runner/y.h"));
}

TEST(LayeringRules, HeadersWithoutGuardAreFound) {
  EXPECT_TRUE(lacksPragmaOnce({"framework/a.h", "struct A {};\n"}));
  EXPECT_FALSE(lacksPragmaOnce({"framework/a.cpp", "struct A {};\n"}));
}

TEST(LayeringRules, LengthIsCountedInLines) {
  const auto lines = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "x\n";
    return text;
  };
  EXPECT_FALSE(isTooLong({"framework/a.cpp", lines(800)}));
  EXPECT_TRUE(isTooLong({"framework/a.cpp", lines(800) + "x"}));
  EXPECT_FALSE(isTooLong({"modules/README.md", lines(40)}));
  EXPECT_TRUE(isTooLong({"modules/README.md", lines(41)}));
  EXPECT_FALSE(isTooLong({"config/README.md", lines(140)}));
  EXPECT_FALSE(isTooLong({"config/meshes/bunny.obj", lines(5000)}));
}

TEST(LayeringRules, PathsOfOneMachineAreFound) {
  // concatenated, so that this file does not break the rule
  const std::string home = std::string("/ho") + "me/ada/presa";
  EXPECT_TRUE(namesPathOfOneMachine({"apps/a.cpp", "open(\"" + home + "\");"}));
  EXPECT_TRUE(namesPathOfOneMachine({"apps/README.md", "see " + home}));
  EXPECT_FALSE(namesPathOfOneMachine({"apps/README.md", "the frame" + std::string("/wo") + "rk/flow of devices"}));
}

TEST(LayeringRules, ReadersOfTheWallClockAreFound) {
  for (const char* read : {"clock_gettime(CLOCK_REALTIME, &t)", "std::chrono::system_clock::now()",
                           "std::time(nullptr)", "gettimeofday(&t, 0)", "time(&now)"}) {
    EXPECT_TRUE(readsTheWallClock({"framework/a.cpp", read})) << read;
    EXPECT_TRUE(readsTheWallClock({"devices/b/a.h", read})) << read;
    EXPECT_FALSE(readsTheWallClock({"apps/presa/a.cpp", read})) << read;
  }
  EXPECT_FALSE(
      readsTheWallClock({"framework/a.cpp", "clock_gettime(CLOCK_MONOTONIC, &t); sample.time(0.1); motion.at(time)"}));
}

TEST(LayeringRules, FilesOpenedPastTheDoorAreFound) {
  for (const std::string opens : {"std::ifstream in(file);", "std::fopen(name, \"rb\")", "H5Fopen(f, 0, 0)"}) {
    EXPECT_TRUE(opensAFileByItself({"framework/a/b.cpp", opens})) << opens;
    EXPECT_TRUE(opensAFileByItself({"apps/presa/b.cpp", opens})) << opens;
    EXPECT_FALSE(opensAFileByItself({"tests/a/b.cpp", opens})) << opens;
  }
  EXPECT_FALSE(
      opensAFileByItself({"framework/a/b.cpp", "input::read(file, kMost, refusal); std::ofstream out(file);"}));
}

}  // namespace
}  // namespace presa::layering
