// A stiffness above the rig's bound is lowered, with a note; a recording holds the lowered value.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/apps/presa/support.h"

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

}  // namespace
}  // namespace presa::test
