#include <gtest/gtest.h>

#include <fstream>

#include "framework/scene/load.h"
#include "framework/scene/world.h"
#include "framework/session/load_world.h"
#include "framework/session/plan.h"

namespace presa {
namespace {

Rig rigOf(const std::string& bus, Diagnostics& diagnostics) {
  return parseRig("<rig version=\"1.0\" name=\"desk\">" + bus + "<device role=\"thumb\" driver=\"scripted\"/></rig>",
                  "rig", ".", diagnostics);
}

TEST(BusSettings, AreReadFromTheRig) {
  Diagnostics diagnostics;
  EXPECT_FALSE(rigOf("", diagnostics).bus.has_value());
  const Rig rig = rigOf(R"(<bus network="lan:eth0" domain="17"/>)", diagnostics);
  ASSERT_TRUE(rig.bus.has_value());
  EXPECT_EQ(rig.bus->network, "lan:eth0");
  EXPECT_EQ(rig.bus->domain, 17);
  EXPECT_EQ(rigOf(R"(<bus network="loopback"/>)", diagnostics).bus->domain, 0);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
}

TEST(BusSettings, AreReadFromTheScene) {
  Diagnostics diagnostics;
  const std::string xml = R"(<scene version="1.0" name="s"><world gravity="0 0 0"/><bus network="loopback"/>
    <materials><material name="wood" stiffness="1000"/></materials>
    <body name="table" fixed="true"><haptic><box size="1 1 1"/></haptic></body></scene>)";
  const Scene scene = parseScene(xml, "scene", ".", {{"bus/domain", "5"}}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  ASSERT_TRUE(scene.bus.has_value());
  EXPECT_EQ(scene.bus->network, "loopback");
  EXPECT_EQ(scene.bus->domain, 5);
  // a recording or a viewer parses the resolved scene again
  EXPECT_EQ(parseScene(scene.resolved_xml, "again", ".", {}, diagnostics).bus->domain, 5);
}

TEST(BusSettings, AreRefusedWithAPlaceAndWhatIsAllowed) {
  for (const char* bus :
       {R"(<bus network="wifi"/>)", R"(<bus network="lan:"/>)", R"(<bus network="loopback" domain="201"/>)",
        R"(<bus network="loopback" domain="-1"/>)", "<bus/>", R"(<bus network="loopback"/><bus network="lan"/>)"}) {
    Diagnostics diagnostics;
    rigOf(bus, diagnostics);
    EXPECT_TRUE(diagnostics.hasErrors()) << bus;
    EXPECT_NE(diagnostics.text().find("rig:1:"), std::string::npos) << bus << '\n' << diagnostics.text();
  }
  Diagnostics diagnostics;
  rigOf(R"(<bus network="wifi"/>)", diagnostics);
  EXPECT_NE(diagnostics.text().find("loopback, lan, lan:INTERFACE"), std::string::npos) << diagnostics.text();
}

Scene sceneWith(const std::string& bus, const std::vector<Override>& overrides, Diagnostics& diagnostics) {
  const std::string xml = R"(<scene version="1.0" name="s"><world gravity="0 0 0"/>)" + bus + R"(
    <materials><material name="wood" stiffness="1000"/></materials>
    <body name="table" fixed="true"><haptic><box size="1 1 1"/></haptic></body></scene>)";
  return parseScene(xml, "scene", ".", overrides, diagnostics);
}

// A scene may come from an untrusted source: it opens no network and grants no access.
TEST(BusSettings, OfASceneOpenNeitherTheNetworkNorCommands) {
  for (const char* bus : {R"(<bus network="lan"/>)", R"(<bus network="lan:eth0"/>)",
                          R"(<bus network="loopback" commands="true"/>)", R"(<bus network="none" commands="1"/>)"}) {
    Diagnostics diagnostics;
    const Scene scene = sceneWith(bus, {}, diagnostics);
    EXPECT_TRUE(diagnostics.hasErrors()) << bus;
    EXPECT_NE(diagnostics.text().find("scene:1:"), std::string::npos) << diagnostics.text();
    EXPECT_NE(diagnostics.text().find("error[E751]"), std::string::npos) << diagnostics.text();
    EXPECT_FALSE(scene.bus.has_value()) << bus;
  }
  Diagnostics both;
  sceneWith(R"(<bus network="lan" commands="true"/>)", {}, both);
  EXPECT_EQ(both.errorCount(), 2u) << both.text();
  Diagnostics set;
  sceneWith(R"(<bus network="loopback"/>)", {{"bus/network", "lan"}}, set);
  EXPECT_TRUE(set.hasErrors());
  Diagnostics good;
  EXPECT_EQ(sceneWith(R"(<bus network="loopback" commands="false"/>)", {}, good).bus->network, "loopback");
  EXPECT_FALSE(good.hasErrors()) << good.text();
}

// The same holds for a rig that only the scene names.
TEST(BusSettings, OfARigThatTheSceneChoseOpenNothingEither) {
  const std::string folder = testing::TempDir(), scene = folder + "/bus_chosen.xml",
                    rig = folder + "/bus_chosen_rig.xml";
  std::ofstream(scene) << R"(<scene version="1.0" name="s" rig="bus_chosen_rig.xml"><world gravity="0 0 0"/>
    <materials><material name="wood" stiffness="1000"/></materials>
    <body name="table" fixed="true"><haptic><box size="1 1 1"/></haptic></body>
    <devices><device role="thumb"/></devices></scene>)";
  const auto said = [&](const std::string& bus, const std::string& named, const std::optional<BusSettings>& option) {
    std::ofstream(rig) << "<rig version=\"1.0\" name=\"desk\">" << bus
                       << R"(<device role="thumb" driver="scripted"><set key="motion" value=")" << PRESA_SOURCE_DIR
                       << R"(/config/motions/pinch_cube.xml"/></device></rig>)";
    RunOptions options;
    options.bus = option;
    Diagnostics diagnostics;
    loadWorld({scene, named, {}}, options, diagnostics);
    return diagnostics.text();
  };
  for (const char* bus : {R"(<bus network="lan"/>)", R"(<bus network="loopback" commands="true"/>)"}) {
    EXPECT_NE(said(bus, "", {}).find("error[E751]"), std::string::npos) << bus;
    EXPECT_EQ(said(bus, rig, {}).find("E751"), std::string::npos) << bus;
    EXPECT_EQ(said(bus, "", BusSettings{.network = "none"}).find("E751"), std::string::npos) << bus;
  }
  EXPECT_EQ(said(R"(<bus network="loopback"/>)", "", {}).find("error["), std::string::npos);
}

TEST(BusSettings, OfARigNameItsKeysRelativeToIt) {
  Diagnostics diagnostics;
  const Rig rig = parseRig(R"(<rig version="1.0" name="desk"><bus network="lan" keys="keys/run"/>
    <device role="thumb" driver="scripted"/></rig>)",
                           "rig", "/lab", diagnostics);
  ASSERT_TRUE(rig.bus.has_value()) << diagnostics.text();
  EXPECT_EQ(rig.bus->keys, "/lab/keys/run");
}

TEST(BusSettings, NameANetwork) {
  for (const char* good : {"loopback", "lan", "lan:eth0", "lan:wlp3s0.7", "none"})
    EXPECT_TRUE(isBusNetwork(good)) << good;
  for (const char* bad : {"", "lo", "lan:", "lan:a b", "lan:\"/><x", "lan:abcdefghijklmnop", "LAN"})
    EXPECT_FALSE(isBusNetwork(bad)) << bad;
}

// The command line takes precedence over the rig, also with "none"; the plan names the source of the setting.
TEST(BusSettings, OfTheCommandLineGoBeforeTheRigs) {
  Scene scene;
  scene.name = "cube";
  Rig rig;
  rig.name = "desk";
  RunOptions options;
  const auto planned = [&] {
    Diagnostics diagnostics;
    const Plan plan = makePlan(scene, rig, bindDevices(scene, rig, diagnostics), options, diagnostics);
    for (const PlannedModule& module : plan.modules) {
      if (module.plugin == "bus_dds") return module.reason;
    }
    return std::string("left out");
  };
  EXPECT_EQ(planned(), "left out");
  scene.bus = BusSettings{"loopback", 0};
  EXPECT_EQ(planned(), "the scene 'cube' publishes on bus 'loopback'");
  rig.bus = BusSettings{"lan", 3};
  EXPECT_EQ(planned(), "the rig 'desk' publishes on bus 'lan'");
  options.bus = BusSettings{"loopback", 0};
  EXPECT_EQ(planned(), "--bus loopback");
  EXPECT_EQ(busOf(scene, rig, options)->network, "loopback");
  options.bus->network = "none";
  EXPECT_EQ(planned(), "left out");
}

}  // namespace
}  // namespace presa
