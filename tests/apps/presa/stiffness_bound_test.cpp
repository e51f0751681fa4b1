// A stiffness or a damping above the rig's bound is lowered, with a note; a recording holds the lowered value.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/device/wrapped_device.h"
#include "framework/session/stiffness_bound.h"
#include "tests/apps/support/support.h"

namespace presa::test {
namespace {

std::string softRig(double damping) {
  const std::string file = scratch("soft.xml");
  std::ofstream rig(file);
  rig << "<?xml version=\"1.0\"?>\n<rig version=\"1.0\" name=\"soft\">\n";
  for (const char* role : {"thumb", "index"})
    rig << "<device role=\"" << role << "\" driver=\"scripted\"><set key=\"motion\" value=\""
        << source("config/motions/pinch_cube.xml") << "\"/><set key=\"damping\" value=\"" << damping
        << "\"/></device>\n";
  rig << "</rig>\n";
  return file;
}

double rubberOf(const std::string& rig, double asked, bool bounded, Diagnostics& diagnostics) {
  RunOptions options;
  options.bound_stiffness = bounded;
  const Loaded loaded =
      loadWorld({source("config/scenes/cube.xml"),
                 rig,
                 {"material/rubber/stiffness=" + std::to_string(asked), "material/wood/stiffness=100"}},
                options, diagnostics);
  return loaded.world->scene.materials.at(0).stiffness;
}

// b = 6 N s/m at 1 kHz: K_max = 2 b / T = 12 N/mm, half of it 6 N/mm.
TEST(StiffnessBound, IsHalfOfWhatTheDampingHolds) {
  const std::string rig = softRig(6);
  Diagnostics below, above, study;
  EXPECT_EQ(rubberOf(rig, 5999, true, below), 5999);
  EXPECT_TRUE(below.all().empty()) << below.text();
  EXPECT_NEAR(rubberOf(rig, 9000, true, above), 6000, 1e-9);
  ASSERT_EQ(above.all().size(), 1u) << above.text();
  EXPECT_EQ(above.all()[0].code, 454);
  EXPECT_EQ(above.all()[0].severity, Diagnostic::Severity::kWarning);
  EXPECT_NE(above.all()[0].message.find("K_max = b / ((d + 1/2) T) = 12 N/mm"), std::string::npos) << above.text();
  // a study beyond the bound switches the lowering off
  EXPECT_EQ(rubberOf(rig, 9000, false, study), 9000);
}

TEST(StiffnessBound, DampingThatWasChosenForAStiffnessIsNotTooLittleForIt) {
  for (const char* rig : {"pinch_cube", "pinch_cube_percro"}) {
    for (const double stiffness : {500.0, 1000.0, 10000.0}) {
      Diagnostics diagnostics;
      EXPECT_EQ(rubberOf(source("config/rigs/") + rig + ".xml", stiffness, true, diagnostics), stiffness) << rig;
    }
  }
}

TEST(StiffnessBound, ARecordingHoldsWhatWasFelt) {
  const std::string recording = scratch("bounded.h5");
  const Outcome run =
      presa("run " + source("config/scenes/cube.xml") + " --rig " + softRig(6) +
            " --set material/rubber/stiffness=9000 --lockstep --for 3 --view none --quiet --record " + recording);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("W454"), std::string::npos) << run.err;
  const Outcome again = presa("replay --verify " + recording);
  EXPECT_EQ(again.status, 0) << again.out << again.err;
}

/// A device whose handle yields to torque.
class TurningHandle final : public WrappedDevice {
 public:
  using WrappedDevice::WrappedDevice;
  double turnDamping() const override { return 0.001; }
};

// K_max of 0.001 N m s/rad and half of 1 ms is 2 N m/rad, in force the scripted hand's own.
TEST(StiffnessBound, HandlesOfToolsAreHeldToItInForceAndInTurning) {
  Diagnostics diagnostics;
  Loaded loaded = loadWorld({source("config/scenes/square_peg.xml"), "", {}}, {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  const Scene& scene = loaded.world->scene;
  EXPECT_TRUE(boundedHandles(loaded.devices, loaded.plan, scene, diagnostics).empty());
  loaded.devices[0] = std::make_unique<TurningHandle>(std::move(loaded.devices[0]));
  const auto lowered = boundedHandles(loaded.devices, loaded.plan, scene, diagnostics);
  ASSERT_EQ(lowered.size(), 1U);
  EXPECT_EQ(lowered[0].path, "device/peg/tool/turn_stiffness");
  EXPECT_EQ(std::stod(lowered[0].value), 1);
  EXPECT_NE(diagnostics.text().find("turning the handle of tool 'peg' of 2 N m/rad is felt with 1 N m/rad"),
            std::string::npos)
      << diagnostics.text();
}

double dampingOf(const std::string& rig, const std::vector<std::string>& sets, bool bounded, Diagnostics& diagnostics) {
  RunOptions options;
  options.bound_stiffness = bounded;
  const Loaded loaded = loadWorld({source("config/scenes/cube.xml"), rig, sets}, options, diagnostics);
  return loaded.world->scene.materials.at(0).damping;
}

// The scripted fingers have m = 0.1 kg. At 1 kHz a damper of 2 m / T = 200 N s/m reverses the speed at every tick, half
// of it stops the finger in one; at 2 kHz both are twice as large.
TEST(DampingBound, IsHalfOfWhatTheMassHolds) {
  const std::string rig = source("config/rigs/pinch_cube.xml");
  Diagnostics below, above, faster, study;
  EXPECT_EQ(dampingOf(rig, {"material/rubber/damping=100"}, true, below), 100);
  EXPECT_TRUE(below.all().empty()) << below.text();
  EXPECT_NEAR(dampingOf(rig, {"material/rubber/damping=500"}, true, above), 100, 1e-9);
  ASSERT_EQ(above.all().size(), 1u) << above.text();
  EXPECT_EQ(above.all()[0].code, 464);
  EXPECT_EQ(above.all()[0].severity, Diagnostic::Severity::kWarning);
  EXPECT_GT(above.all()[0].where.line, 0);
  EXPECT_NE(above.all()[0].message.find("/ T = 200 N s/m, with the m = 0.1 kg"), std::string::npos) << above.text();
  EXPECT_NEAR(dampingOf(rig, {"material/rubber/damping=500", "rates/haptic=2000"}, true, faster), 200, 1e-9);
  EXPECT_EQ(dampingOf(rig, {"material/rubber/damping=500"}, false, study), 500);
}

// Both are lowered at once, and nothing is said twice.
TEST(DampingBound, StandsBesideTheStiffnessBound) {
  Diagnostics diagnostics;
  EXPECT_NEAR(dampingOf(softRig(6),
                        {"material/rubber/damping=500", "material/rubber/stiffness=9000", "material/wood/stiffness=100",
                         "body/table/physics/mass=1"},
                        true, diagnostics),
              100, 1e-9);
  std::vector<int> codes;
  for (const Diagnostic& finding : diagnostics.all()) codes.push_back(finding.code);
  std::ranges::sort(codes);
  EXPECT_EQ(codes, (std::vector<int>{220, 454, 464})) << diagnostics.text();
}

// Unbounded, 500 N s/m make the grip ripple by 127 %; nobody feels 0.1 %, as the just noticeable difference of force is 7
// % and more.
TEST(DampingBound, KeepsTheGripCalm) {
  const std::string summary = scratch("damped.json");
  for (const char* damping : {"100", "200", "500", "1000"}) {
    const Outcome run = presa("run " + source("config/scenes/cube.xml") + " --set material/rubber/damping=" + damping +
                              " --lockstep --view none --quiet --summary " + summary);
    ASSERT_EQ(run.status, 0) << run.err;
    std::ifstream file(summary);
    const nlohmann::json grasp = nlohmann::json::parse(file).at("grasp");
    for (const auto& finger : grasp.at("fingers")) EXPECT_LT(finger.at("grip_ripple").get<double>(), 1e-3) << damping;
  }
}

}  // namespace
}  // namespace presa::test
