// The knob "law": a scene's friction with each law by its name.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/common/file_text.h"
#include "apps/studies/cost/law_factor.h"
#include "framework/scene/load.h"
#include "tests/apps/support/support.h"

namespace presa::cost {
namespace {

using Sets = std::vector<std::string>;

const std::string kCone = test::source("config/scenes/friction_cone.xml");
const std::string kStribeck = test::source("config/scenes/friction_stribeck.xml");

Factor laws(const std::string& scene, const std::vector<std::string>& values, Diagnostics& diagnostics) {
  Diagnostics ignored;
  return lawFactor(values, loadScene(scene, {}, ignored), {"--knob law", 0, 0}, diagnostics);
}

TEST(LawKnob, ALawByItsNameHasWhatItsElementRequires) {
  Diagnostics diagnostics;
  const Factor factor =
      laws(kCone, {"friction_cone", "friction_stribeck", "friction_lugre:stiffness=500:damping=3"}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  ASSERT_EQ(factor.values.size(), 3u);
  EXPECT_EQ(factor.values[0].sets, Sets{});  // the law of a <friction> that names none
  EXPECT_EQ(factor.values[1].sets, Sets{"material/wood/friction/stribeck/speed=0.02"});
  EXPECT_EQ(factor.values[2].sets,
            (Sets{"material/wood/friction/lugre/damping=3", "material/wood/friction/lugre/speed=0.02",
                  "material/wood/friction/lugre/stiffness=500"}));
}

// A scene's own law keeps its values but for those given; another law would be a second one in the same <friction>.
TEST(LawKnob, ASceneThatNamesItsLawKeepsIt) {
  Diagnostics good;
  const Factor factor = laws(kStribeck, {"friction_stribeck", "friction_stribeck:speed=0.1"}, good);
  EXPECT_FALSE(good.hasErrors()) << good.text();
  EXPECT_EQ(factor.values[0].sets, Sets{});
  EXPECT_EQ(factor.values[1].sets, Sets{"material/wet_glass/friction/stribeck/speed=0.1"});
  Diagnostics bad;
  laws(kStribeck, {"friction_cone"}, bad);
  EXPECT_NE(bad.text().find("names its law, <stribeck>"), std::string::npos) << bad.text();
}

TEST(LawKnob, RefusesWhatIsNoLaw) {
  Diagnostics diagnostics;
  laws(kCone, {"friction_con", "friction_lugre:x", "haptics_proxy"}, diagnostics);
  for (const char* expected : {"did you mean 'friction_cone'?", "found 'x'", "no friction law 'haptics_proxy'"})
    EXPECT_NE(diagnostics.text().find(expected), std::string::npos) << expected << '\n' << diagnostics.text();
  Diagnostics smooth;
  laws(test::source("experiments/accuracy_cost/scenes/buzz.xml"), {"friction_cone"}, smooth);
  EXPECT_NE(smooth.text().find("has friction"), std::string::npos) << smooth.text();
}

TEST(LawKnob, AStudyComparesLaws) {
  const std::string out = test::scratch("laws");
  const auto outcome = test::presa("cost " + kCone + " --knob law=friction_cone,friction_stribeck --metric force_rms " +
                                   "--quick --out " + out);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto result = nlohmann::json::parse(contentsOf(out + "/cost.json"));
  ASSERT_EQ(result.at("settings").size(), 2u);
  EXPECT_EQ(result.at("settings")[0].at("knobs").at("law"), "friction_cone");
  EXPECT_EQ(result.at("settings")[1].at("knobs").at("law"), "friction_stribeck");
  // another model, not an error of the rate: far above the 1 kHz error of the cone itself
  EXPECT_GT(result.at("settings")[1].at("error").at("force_rms").get<double>(),
            3 * result.at("settings")[0].at("error").at("force_rms").get<double>());
}

}  // namespace
}  // namespace presa::cost
