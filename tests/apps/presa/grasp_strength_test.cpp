// How good the grasp of a run is: in the summary, and for people (`presa explain --grasp`).
#include "apps/common/grasp_strength.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/summary.h"
#include "tests/apps/support/support.h"

namespace presa::test {
namespace {

constexpr const char* kPinch = "config/scenes/cube.xml";
constexpr double kRubber = 0.8, kCubeMass = 0.2, kHalfEdge = 0.035;  // of the shipped cube, half of its edge [m]
const double kCubeWeight = kCubeMass * 9.81;

nlohmann::json graspOf(const TerminalRun& run) { return nlohmann::json::parse(summaryJson(run.result())).at("grasp"); }

// Two point fingers 5 mm above the centre of mass.
TEST(GraspStrength, OfTheShippedPinchIsThatOfTwoPointFingers) {
  const auto run = runScene(kPinch);
  const nlohmann::json grasp = graspOf(*run);
  EXPECT_EQ(grasp.at("closure"), "partial");
  EXPECT_EQ(grasp.at("quality"), 0.0);
  EXPECT_EQ(grasp.at("quality_at_most"), 0.0);
  EXPECT_EQ(grasp.at("weakest"), "turns about the line between the fingers");
  const double normal = grasp.at("fingers")[0].at("mean_normal_force_N").get<double>();
  const double margin = 2 * kRubber * normal / kCubeWeight, min_grip = kCubeWeight / (2 * kRubber);
  // the bounds meet within kMeet and lie on the safe side; the cube sways, and its faces turn with it, by 1e-6
  const double rounding = 1e-5;
  EXPECT_LE(grasp.at("slip_margin").get<double>(), margin * (1 + rounding));
  EXPECT_GE(grasp.at("slip_margin").get<double>(), margin * (1 - ProvenBounds::kMeet));
  EXPECT_GE(grasp.at("min_grip_N").get<double>(), min_grip * (1 - rounding));
  EXPECT_LE(grasp.at("min_grip_N").get<double>(), min_grip * (1 + ProvenBounds::kMeet));
  // the run itself agrees: where it slips, and how much of the friction it uses
  const auto& finger = grasp.at("fingers")[0];
  EXPECT_NEAR(finger.at("slip_onset").at("normal_force_N").get<double>(), min_grip,
              finger.at("slip_known_to_N").get<double>());
  const auto strength = graspStrength(run->result(), *graspFigures(run->result()));
  EXPECT_NEAR(strength->friction_used[0], 1 / margin, 1e-3 / margin);  // sways by 1e-4 of the weight
}

// Soft fingers resist the turn about the line, with mu r: the least of all they resist. The line is 5 mm above the
// centre of mass, which moves with the turn and makes it the longer motion.
TEST(GraspStrength, OfSoftFingersIsFullAndLimitedByTheirTorsion) {
  const auto run = runScene(kPinch, {"material/rubber/friction/torsion=0.005"});
  const nlohmann::json grasp = graspOf(*run);
  EXPECT_EQ(grasp.at("closure"), "full");
  const double exact = kRubber * 0.005 / std::hypot(kHalfEdge, 0.005);
  EXPECT_LE(grasp.at("quality").get<double>(), exact * (1 + 1e-5));  // sways by 1e-6, as above
  EXPECT_GE(grasp.at("quality_at_most").get<double>(), exact * (1 - 1e-5));
  EXPECT_GE(grasp.at("quality").get<double>(), exact * (1 - ProvenBounds::kMeet));
  EXPECT_TRUE(grasp.at("quality_otherwise").is_null());
  EXPECT_EQ(grasp.at("weakest"), "turns about the line between the fingers");
}

// A heavier cube leaves less margin, by the same factor: 2 mu N / (m g).
TEST(GraspStrength, MarginFallsWithTheMass) {
  const double light = graspOf(*runScene(kPinch)).at("slip_margin").get<double>();
  const double heavy = graspOf(*runScene(kPinch, {"body/cube/physics/mass=0.4"})).at("slip_margin").get<double>();
  EXPECT_NEAR(heavy, light / 2, ProvenBounds::kMeet * light / 2);
}

// Another law than Coulomb's has no cone: there is nothing to say, and the keys stay.
TEST(GraspStrength, IsUnknownWithoutACone) {
  const auto run = runScene(kPinch);
  RunResult result = run->result();
  for (RunResult::Object& object : result.objects) object.friction_static = 0;
  const auto grasp = nlohmann::json::parse(summaryJson(result)).at("grasp");
  for (const char* key :
       {"closure", "quality", "quality_at_most", "quality_otherwise", "weakest", "slip_margin", "min_grip_N"})
    EXPECT_TRUE(grasp.at(key).is_null()) << key;
}

TEST(ExplainGrasp, SaysHowGoodTheGraspIs) {
  const Outcome text = presa("explain " + source(kPinch) + " --grasp");
  EXPECT_EQ(text.status, 0) << text.err;
  for (const char* part : {"cube held by thumb and index, at 6.99",
                           "force closure    partial: of the body's six motions, 1 is not opposed",
                           "weakest          turns about the line between the fingers: nothing opposes it",
                           "quality          0, but 0.50", "slip margin      4.8", "min grip         1.2"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << '\n' << text.out;
  const Outcome json = presa("explain " + source(kPinch) + " --grasp --format json");
  EXPECT_EQ(nlohmann::json::parse(json.out).at("closure"), "partial");
  EXPECT_NE(presa("explain --help").out.find("--grasp"), std::string::npos);
}

TEST(ExplainGrasp, SaysThatThereIsNone) {
  const Outcome missed = presa("explain " + source(kPinch) + " --grasp --set 'body/cube/pos=0.2 0.1 0.035'");
  EXPECT_EQ(missed.status, 0) << missed.err;
  EXPECT_EQ(missed.out, "Scene cube: no grasp, nothing was held by two fingers during the hold.\n");
  const Outcome stroke = presa("explain " + source("config/scenes/texture_sine.xml") + " --grasp");
  EXPECT_EQ(stroke.status, 2);
  EXPECT_NE(stroke.err.find("error[E125]: --grasp needs a device with a scripted phase whose intent is hold"),
            std::string::npos)
      << stroke.err;
  const Outcome dot = presa("explain " + source(kPinch) + " --grasp --format dot");
  EXPECT_EQ(dot.status, 2);
  EXPECT_NE(dot.err.find("error[E123]"), std::string::npos) << dot.err;
}

}  // namespace
}  // namespace presa::test
