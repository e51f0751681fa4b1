// Tools and bodies that make a contact method fail: needles, giants, meshes without an inside, starts inside, fast spins.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/core/diagnostics/refuse.h"
#include "framework/haptics/virtual_coupling.h"
#include "tests/support/mesh_file.h"
#include "tests/support/one_tool.h"

namespace presa::hard_tools_test {
namespace {

using test::OneTool;
using test::slab;
using test::toolWorld;
using test::turned;

constexpr double kSeries = 1000.0 * 200000 / 201000;  // handle and contact [N/m]

TEST(HardTools, ANeedleIsHeldAsABlockIs) {
  OneTool tool(toolWorld(R"(<tool><box size="0.0005 0.0005 0.1"/></tool>)", slab()));
  tool.tick({{0, 0, 0.06}, Quat::Identity()});
  const FingerContact& contact = tool.rest({{0, 0, 0.048}, Quat::Identity()}, 50);
  EXPECT_NEAR(contact.f_H_W.z(), 0.002 * kSeries, 0.01);
  EXPECT_LT(tool.state().depth, 0.0001);
}

TEST(HardTools, AToolLargerThanTheWorldTouchesWhatIsThere) {
  OneTool tool(
      toolWorld(R"(<tool><box size="2 2 1"/></tool>)",
                R"(<body name="ball" fixed="true" material="smooth"><haptic><sphere radius="0.01"/></haptic></body>)",
                R"(<pointshell max_points="400000"/>)"));
  tool.tick({{0, 0, 0.52}, Quat::Identity()});
  const FingerContact& contact = tool.rest({{0.003, 0.002, 0.508}, Quat::Identity()}, 50);
  EXPECT_NEAR(contact.f_H_W.z(), 2, 1.0) << "its points lie 6 mm apart: the ball rises between them by less than 1 mm";
  EXPECT_GT(contact.f_H_W.z(), 0.5);
}

// The hand starts 5 mm deep: it is not thrown out, but feels at once what it would feel after coming there.
TEST(HardTools, AToolThatStartsInsideIsPushedOutWithinItsLimits) {
  OneTool tool(toolWorld(R"(<tool max_force="5"><box size="0.04 0.04 0.04"/></tool>)", slab()));
  const Pose inside{{0, 0, 0.015}, Quat::Identity()};
  for (int i = 0; i < 200; ++i) {
    const FingerContact& contact = tool.tick(inside);
    ASSERT_LE(contact.f_H_W.norm(), 5 + 1e-9) << i;
    ASSERT_TRUE(std::isfinite(contact.t_H_W.norm()));
  }
  EXPECT_NEAR(tool.state().X_WT.p.z(), 0.02, 1e-4) << "it is out";
}

TEST(HardTools, AHandThatJumpsThroughAWallLeavesTheToolBehind) {
  OneTool tool(toolWorld(
      R"(<tool><box size="0.04 0.04 0.04"/></tool>)",
      R"(<body name="plate" fixed="true" material="smooth"><haptic><box size="0.4 0.4 0.004"/></haptic></body>)"));
  tool.rest({{0, 0, 0.025}, Quat::Identity()}, 10);
  const FingerContact& contact = tool.rest({{0, 0, -0.3}, Quat::Identity()}, 500);
  EXPECT_GT(tool.state().X_WT.p.z(), 0.0215);
  EXPECT_LT(contact.f_H_W.norm(), 8);
  EXPECT_GT(contact.f_H_W.z(), 7);
}

// Oracle: a spin of 10 rad/s against friction costs the hand energy, never gives it any.
TEST(HardTools, ASpinOfTenRadiansASecondCostsEnergy) {
  OneTool tool(toolWorld(R"(<tool turn_stiffness="2"><box size="0.05 0.03 0.02"/></tool>)", slab("rough")));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  double energy = 0;
  Pose last{{0, 0, 0.008}, Quat::Identity()};
  tool.rest(last, 50);
  for (int i = 1; i <= 5000; ++i) {
    const Pose hand{{0, 0, 0.008}, turned({0, 0, 1}, 0.01 * i * 180 / EIGEN_PI)};
    const FingerContact& contact = tool.tick(hand);
    energy += contact.t_H_W.dot(turnBetween(last.q, hand.q));
    last = hand;
    ASSERT_LT(contact.t_H_W.norm(), 0.5 + 1e-9);
  }
  EXPECT_LT(energy, -0.1);
  // a pressed rectangle resists with mu F times the mean distance from its middle, 15.6 mm: in 50 rad 0.61 J
  EXPECT_NEAR(energy, -50 * 0.4 * 0.002 * kSeries * 0.0156, 0.1);
}

std::string refusal(const std::string& body, const std::string& settings = "") {
  try {
    OneTool tool(toolWorld(R"(<tool><box size="0.04 0.04 0.04"/></tool>)", body, settings));
  } catch (const InputError& error) {
    return error.diagnostics().text();
  }
  return "";
}

TEST(HardTools, ABodyWithoutAnInsideIsRefusedWithItsName) {
  EXPECT_EQ(refusal(slab()), "");
  TriMesh sheet = makeBox({0.1, 0.1, 0.1});
  sheet.triangles.resize(10);
  const std::string open = refusal(test::MeshFile(sheet, "open").body("sheet", "smooth"));
  EXPECT_NE(open.find("E596"), std::string::npos) << open;
  EXPECT_NE(open.find("'sheet' is open"), std::string::npos) << open;
}

TEST(HardTools, FieldsAboveTheirMemoryAreRefusedWithTheirSize) {
  const test::MeshFile cube(makeBox({0.06, 0.06, 0.06}), "cube");
  const std::string large = refusal(cube.body("cube", "smooth"), R"(<pointshell voxel="0.00005" memory="16"/>)");
  EXPECT_NE(large.find("E596"), std::string::npos) << large;
  EXPECT_NE(large.find("'cube' needs"), std::string::npos) << large;
  EXPECT_NE(large.find("MiB"), std::string::npos) << large;
}

// Dragged over a mesh at constant depth. The printed law jumps where points change their voxel, ours does not.
double largestStep(const std::string& settings) {
  const test::MeshFile cube(makeBox({0.06, 0.06, 0.06}), "cube");
  OneTool tool(toolWorld(R"(<tool><box size="0.01 0.008 0.006"/></tool>)", cube.body("cube", "smooth"), settings));
  const AxisBox box = boundsOf(*tool.world().meshes[0].haptic);
  const Vec3 top((box.low.x() + box.high.x()) / 2 - 0.01, (box.low.y() + box.high.y()) / 2, box.high.z() + 0.003);
  const Quat tilt = turned({1, 2, 0}, 12);
  tool.tick({top + Vec3(0, 0, 0.01), tilt});
  tool.rest({top, tilt}, 100);
  double largest = 0, mean = 0;
  Vec3 last = tool.rest({top, tilt}, 100).f_H_W;
  for (int i = 1; i <= 2000; ++i) {
    const Vec3 now = tool.tick({top + Vec3(1e-5 * i, 0.3e-5 * i, 0), tilt}).f_H_W;
    largest = std::max(largest, (now - last).norm());
    mean += now.norm() / 2000;
    last = now;
  }
  EXPECT_GT(mean, 0.5);
  return largest / mean;
}

TEST(HardTools, TheForceIsContinuousOverVoxelBordersAndThePrintedLawIsNot) {
  const double ours = largestStep(""), printed = largestStep(R"(<pointshell printed="true"/>)");
  std::printf("largest step at 10 um a tick: %.3f %% of the force, printed law %.3f %%\n", 100 * ours, 100 * printed);
  EXPECT_LT(ours, 0.01);
  EXPECT_GT(printed, 3 * ours);
}

}  // namespace
}  // namespace presa::hard_tools_test
