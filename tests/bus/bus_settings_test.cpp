#include <gtest/gtest.h>

#include "framework/plan/plan.h"
#include "framework/scene/load.h"
#include "framework/scene/world.h"

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
  // as a recording, or a viewer, reads it again
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

TEST(BusSettings, NameANetwork) {
  for (const char* good : {"loopback", "lan", "lan:eth0", "lan:wlp3s0.7", "none"})
    EXPECT_TRUE(isBusNetwork(good)) << good;
  for (const char* bad : {"", "lo", "lan:", "lan:a b", "lan:\"/><x", "lan:abcdefghijklmnop", "LAN"})
    EXPECT_FALSE(isBusNetwork(bad)) << bad;
}

// What the user says goes before the rig, also when it is "none"; and the plan says who asked.
TEST(BusSettings, OfTheCommandLineGoBeforeTheRigs) {
  Scene scene;
  scene.name = "cube";
  Rig rig;
  rig.name = "desk";
  RunOptions options;
  const auto planned = [&] {
    Diagnostics diagnostics;
    const Plan plan = makePlan(scene, rig, options, diagnostics);
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
