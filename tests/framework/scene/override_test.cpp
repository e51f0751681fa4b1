#include "framework/scene/ages.h"
#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

Scene load(const std::vector<Override>& overrides, const std::string& text = kScene) {
  Diagnostics findings;
  Scene scene = parseScene(text, "scene.xml", "/lab", overrides, findings);
  EXPECT_FALSE(findings.hasErrors()) << findings.text();
  return scene;
}

Diagnostic onlyFinding(const std::string& path, const std::string& value) {
  const Diagnostics findings = findingsOf(kScene, {{path, value}});
  EXPECT_EQ(findings.all().size(), 1U) << findings.text();
  return findings.all().empty() ? Diagnostic{} : findings.all()[0];
}

TEST(Override, ReachesEveryKindOfValue) {
  EXPECT_EQ(load({{"body/cube/physics/mass", "0.5"}}).bodies[1].mass, 0.5);
  EXPECT_EQ(load({{"material/rubber/stiffness", "700"}}).materials[0].stiffness, 700);
  EXPECT_EQ(load({{"material/rubber/friction/static", "0.9"}}).materials[0].friction_static, 0.9);
  EXPECT_EQ(load({{"rates/dynamics", "500"}}).rates.dynamics, 500);
  EXPECT_EQ(load({{"world/gravity", "0 0 -1.62"}}).gravity.z(), -1.62);
  EXPECT_EQ(load({{"device/thumb/limits/force", "3"}}).devices[0].limits.force, 3);
  EXPECT_EQ(load({{"body/cube/pos", "1 2 3"}}).bodies[1].X_WB.p, Vec3(1, 2, 3));
  EXPECT_EQ(load({{"body/cube/physics/cylinder/radius", "0.04"}}).bodies[1].physics->shape.index(), 3U);
  EXPECT_EQ(load({{"name", "other"}}).name, "other");
}

// Of several shapes of one kind a path says which; without a number it names one only if there is one of its kind.
TEST(Override, DoesNotGuessAmongSeveralShapes) {
  const std::string one = "<cylinder radius=\"0.03\" length=\"0.07\"/>";
  const std::vector<Override> change{{"body/cube/physics/sphere/radius", "0.04"}};
  Diagnostics good;
  const std::string mixed = edited(kScene, one, one + "<sphere radius=\"0.02\"/>");
  const Scene scene = parseScene(mixed, "scene.xml", "/lab", change, good);
  ASSERT_TRUE(good.all().empty()) << good.text();
  EXPECT_EQ(std::get<Sphere>(std::get<Compound>(scene.bodies[1].physics->shape).parts[1].shape).radius, 0.04);
  const std::string two = edited(kScene, one, "<sphere radius=\"0.02\"/><sphere radius=\"0.03\"/>");
  Diagnostics numbered;
  const Scene second = parseScene(two, "scene.xml", "/lab", {{"body/cube/physics/sphere[2]/radius", "0.05"}}, numbered);
  ASSERT_TRUE(numbered.all().empty()) << numbered.text();
  const auto& parts = std::get<Compound>(second.bodies[1].physics->shape).parts;
  EXPECT_EQ(std::get<Sphere>(parts[0].shape).radius, 0.02);
  EXPECT_EQ(std::get<Sphere>(parts[1].shape).radius, 0.05);
  for (const char* which : {"sphere", "sphere[3]", "sphere[0]", "sphere[2", "sphere[x]"}) {
    const std::string path = std::string("body/cube/physics/") + which + "/radius";
    const Diagnostics findings = findingsOf(two, {{path, "0.04"}});
    ASSERT_EQ(findings.all().size(), 1U) << findings.text();
    EXPECT_EQ(findings.all()[0].code, 202) << findings.text();
  }
  const Diagnostics findings = findingsOf(two, change);
  EXPECT_NE(findings.text().find("holds 2 <sphere>"), std::string::npos) << findings.text();
  EXPECT_NE(findings.text().find("sphere[1] to sphere[2]"), std::string::npos) << findings.text();
}

TEST(Override, ListsMayBeWrittenOrSkipped) {
  EXPECT_EQ(load({{"materials/material/wood/stiffness", "700"}}).materials[1].stiffness, 700);
  EXPECT_EQ(load({{"devices/device/index/fingertip_radius", "0.01"}}).devices[1].fingertip_radius, 0.01);
}

// A star stands for every element or name from which the path can go on: the table has no <visual>, wood gets its
// <friction>.
TEST(Override, AStarReachesEveryElement) {
  for (const Body& body : load({{"body/*/pos", "0 0 3"}}).bodies) EXPECT_EQ(body.X_WB.p.z(), 3);
  EXPECT_EQ(load({{"*/dynamics", "250"}}).rates.dynamics, 250);
  for (const Material& material : load({{"material/*/friction/static", "0.7"}}).materials)
    EXPECT_EQ(material.friction_static, 0.7);
  load({{"body/*/visual/pos", "0 0 1"}});
}

// An attribute with a default can be overridden even if it is absent from the file.
TEST(Override, ReachesValuesThatStandNotInTheFile) {
  EXPECT_EQ(load({{"material/wood/damping", "3"}}).materials[1].damping, 3);
  EXPECT_EQ(load({{"material/wood/friction/dynamic", "0.3"}}).materials[1].friction_dynamic, 0.3);
  EXPECT_EQ(load({{"device/index/limits/force_rate", "300"}}).devices[1].limits.force_rate, 300);
  const std::string without_rates =
      edited(kScene, "  <rates haptic=\"1000\" collision=\"100\" dynamics=\"200\" view=\"60\"/>\n", "");
  const Scene scene = load({{"rates/haptic", "2000"}}, without_rates);
  EXPECT_EQ(scene.rates.haptic, 2000);
  EXPECT_EQ(scene.rates.dynamics, 200);
}

// Both attributes of a pair express the same thing: setting one removes the other.
TEST(Override, DensityReplacesMassAndQuatReplacesEuler) {
  const Scene scene = load({{"body/cube/physics/density", "500"}, {"body/cube/quat", "0 1 0 0"}});
  EXPECT_FALSE(scene.bodies[1].mass);
  EXPECT_EQ(scene.bodies[1].density, 500);
  EXPECT_EQ(scene.bodies[1].X_WB.q.x(), 1);
}

TEST(Override, LastOneWins) {
  EXPECT_EQ(load({{"body/cube/physics/mass", "1"}, {"body/cube/physics/mass", "2"}}).bodies[1].mass, 2);
}

TEST(Override, IsPartOfTheResolvedScene) {
  const Scene scene = load({{"body/cube/physics/mass", "0.5"}});
  EXPECT_EQ(load({}, scene.resolved_xml).bodies[1].mass, 0.5);
}

struct BadPath {
  const char* path;
  const char* says;
};

TEST(Override, PathThatLeadsNowhereSaysWhatExistsThere) {
  const BadPath kBad[] = {
      {"body/cub/physics/mass", "no body 'cub' (did you mean 'cube'?)"},
      {"body/cub/physics/mass", "table, cube"},
      {"bdy/cube/physics/mass", "did you mean 'body'"},
      {"body/cube/phisics/mass", "did you mean 'physics'"},
      {"body/cube/physics/mas", "did you mean 'mass'"},
      {"body/cube/physics/box/size", "it holds <cylinder>"},
      {"body/table/visual/pos", "has no <visual>"},
      {"body/cube", "the path ends at an element"},
      {"body", "the path ends at an element"},
      {"body/cube/physics", "mass, density"},
      {"world/gravity/z", "nothing can follow"},
      {"material/ruber/stiffness", "did you mean 'rubber'"},
      {"device/thumb/limits/forse", "did you mean 'force'"},
      {"", "a part of the path is empty"},
      {"body//physics/mass", "a part of the path is empty"},
      {"colour", "world, rates"},
      {"body/*/physic/mass", "nothing at body/* has 'physic'"},
      {"*/colour", "nothing at * has 'colour'"},
      {"body/*", "no body '*'"},
  };
  for (const BadPath& bad : kBad) {
    const Diagnostic finding = onlyFinding(bad.path, "1");
    EXPECT_EQ(finding.code, 202) << bad.path;
    EXPECT_EQ(finding.where.file, std::string("--set ") + bad.path + "=1");
    EXPECT_NE((finding.message + "\n" + finding.help).find(bad.says), std::string::npos)
        << format(finding) << "\nshould say: " << bad.says;
  }
}

// A wrong value on the command line gives the same error as in the file, located at the --set option.
TEST(Override, WrongValueIsToldWithItsPlaceOnTheCommandLine) {
  const Diagnostic mass = onlyFinding("body/cube/physics/mass", "-1");
  EXPECT_EQ(mass.code, 117);
  EXPECT_EQ(format(mass).rfind("--set body/cube/physics/mass=-1: error[E117]: ", 0), 0U) << format(mass);
  EXPECT_EQ(onlyFinding("rates/dynamics", "300").code, 209);
  EXPECT_EQ(onlyFinding("body/cube/material", "ruber").code, 204);
  EXPECT_EQ(onlyFinding("body/cube/name", "table").code, 203);
}

// A watchdog set by the user is not changed silently. With a slower dynamics it would trigger all the time, so it is an
// error at its place in the file. Two periods are enough; without free bodies nothing is checked.
TEST(Override, ASlowDynamicsIsRefusedWhereAWatchdogWouldNotBearIt) {
  const Diagnostic finding = onlyFinding("rates/dynamics", "50");
  EXPECT_EQ(finding.code, 222);
  const Marked place = marked(edited(kScene, "watchdog_ms", "@watchdog_ms"));
  EXPECT_EQ(finding.where.line, place.line) << format(finding);
  EXPECT_EQ(finding.where.column, place.column) << format(finding);
  EXPECT_NE(finding.message.find("found 20 ms at 50 Hz"), std::string::npos) << finding.message;
  EXPECT_NE(finding.help.find("\"40\""), std::string::npos) << finding.help;
  EXPECT_FALSE(findingsOf(kScene, {{"rates/dynamics", "100"}}).hasErrors());
  EXPECT_FALSE(findingsOf(kScene, {{"rates/dynamics", "50"}, {"device/thumb/limits/watchdog_ms", "40"}}).hasErrors());
  EXPECT_EQ(findingsOf(kScene, {{"rates/dynamics", "50"}, {"device/thumb/limits/watchdog_ms", "39"}}).errorCount(), 1U);
}

// Fingers cannot hold a body that is updated every 100 ms; a rate at which they hold it badly gives a warning. Without
// fingers or free bodies any rate is allowed.
TEST(Override, ADynamicsTooSlowToHoldABodyIsRefused) {
  const std::string free = edited(kScene, " watchdog_ms=\"20\"", "");
  const Diagnostics slow = findingsOf(free, {{"rates/dynamics", "10"}});
  ASSERT_EQ(slow.all().size(), 1U) << slow.text();
  EXPECT_EQ(format(slow.all()[0]).rfind("--set rates/dynamics=10: error[E223]: ", 0), 0U) << slow.text();
  const Diagnostics slowish = findingsOf(free, {{"rates/dynamics", "25"}});
  ASSERT_EQ(slowish.all().size(), 1U) << slowish.text();
  EXPECT_EQ(format(slowish.all()[0]).rfind("--set rates/dynamics=25: warning[W223]: ", 0), 0U) << slowish.text();
  EXPECT_TRUE(findingsOf(free, {{"rates/dynamics", "40"}}).all().empty());
  EXPECT_FALSE(
      findingsOf(edited(free, "<body name=\"cube\"", "<body name=\"cube\" fixed=\"true\""), {{"rates/dynamics", "1"}})
          .hasErrors());
}

// An unset watchdog becomes two periods of the dynamics, at least 20 ms, and is written into the resolved scene.
TEST(Override, AWatchdogThatNobodySetFollowsTheDynamics) {
  const std::string scene = edited(kScene, " watchdog_ms=\"20\"", "");
  for (const auto& [rate, watchdog_ms] :
       {std::pair{"40", 50.}, {"50", 40.}, {"100", 20.}, {"200", 20.}, {"1000", 20.}}) {
    const Scene loaded = load({{"rates/dynamics", rate}}, scene);
    Diagnostics findings;
    const Scene again = parseScene(loaded.resolved_xml, "again", "/", {}, findings);
    EXPECT_TRUE(findings.all().empty()) << findings.text();
    for (const Scene* one : {&loaded, &again}) {
      for (const DeviceRole& device : one->devices) EXPECT_DOUBLE_EQ(device.limits.watchdog_ms, watchdog_ms) << rate;
    }
  }
}

// At the usual rates every limit is exactly 20 ms.
TEST(Ages, AreTwoPeriodsOfTheWriterAndNeverUnderTwentyMilliseconds) {
  const Rates usual;
  EXPECT_EQ(ages::neighbourhoods(usual), 0.020);
  EXPECT_EQ(ages::objects(usual), 0.020);
  EXPECT_EQ(ages::fingers(usual), 0.020);
  Rates slow;
  slow.collision = 10, slow.dynamics = 40;
  EXPECT_DOUBLE_EQ(ages::neighbourhoods(slow), 0.200);
  EXPECT_DOUBLE_EQ(ages::objects(slow), 0.050);
  EXPECT_DOUBLE_EQ(ages::fingers(slow), 0.027);  // two haptic ticks plus the dynamics step solved meanwhile
  Rates fast;
  fast.haptic = 4000, fast.collision = fast.dynamics = 1000;
  EXPECT_EQ(ages::neighbourhoods(fast), 0.020);
  EXPECT_EQ(ages::objects(fast), 0.020);
}

}  // namespace
}  // namespace presa::scene_test
