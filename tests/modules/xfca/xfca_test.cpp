// A convex tool in translation, against bodies for which everything is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "modules/xfca/pair_objects.h"
#include "tests/support/mesh_file.h"
#include "tests/support/tool_laws.h"

namespace presa::xfca_test {
namespace {

using test::OneTool;
using test::slab;
using test::turned;

constexpr double kHandle = 1000;  // [N/m]

std::shared_ptr<const World> xfcaWorld(const std::string& tool, const std::string& bodies,
                                       const std::string& settings = "") {
  return test::toolWorld(tool, bodies, settings, "xfca");
}

const char* const kBall = R"(<tool stiffness="1000"><sphere radius="0.01"/></tool>)";
const char* const kBlock = R"(<tool stiffness="1000" max_force="100"><box size="0.04 0.03 0.02"/></tool>)";

// Oracle: the spring of the handle alone, for the tool is held by a constraint. The skin of 2 um is not felt.
TEST(Xfca, ABallIsPressedBackByTheSpringOfTheHandle) {
  OneTool tool(xfcaWorld(kBall, slab()));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  for (const double depth : {0.0001, 0.001, 0.003}) {
    const FingerContact& contact = tool.rest({{0.01, 0.02, 0.01 - depth}, Quat::Identity()}, 5);
    EXPECT_NEAR(contact.f_H_W.z(), kHandle * depth, 1e-8) << depth;
    EXPECT_NEAR(contact.f_H_W.head<2>().norm(), 0, 1e-9);
    EXPECT_NEAR(contact.t_H_W.norm(), 0, 1e-9) << "the force goes through the ball's middle";
    EXPECT_NEAR(tool.state().X_WT.p.z(), 0.01, 3e-6);
  }
  EXPECT_EQ(tool.state().late, 0U);
}

TEST(Xfca, ABlockFeelsNoTorqueBySymmetry) {
  OneTool tool(xfcaWorld(kBlock, slab()));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  const FingerContact& contact = tool.rest({{0, 0, 0.008}, Quat::Identity()}, 100);
  EXPECT_NEAR(contact.f_H_W.z(), 2, 1e-8);
  EXPECT_NEAR(contact.t_H_W.norm(), 0, 1e-9);
}

// Oracle: the block rests on the corner that is lowest at each angle. As it leans from one side to the other, the centre
// of the pressure moves without a jump: in a tick by no more than the turn of 0.2 mrad times the length over the depth.
TEST(Xfca, ALeaningBlockRollsThePressureFromEdgeToEdge) {
  OneTool tool(xfcaWorld(kBlock, slab()));
  tool.tick({{0, 0, 0.03}, Quat::Identity()});
  Vec3 last = tool.rest({{0, 0, 0.008}, turned({0, 1, 0}, -12)}, 20).t_H_W;
  double largest_step = 0, force = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double angle = -12 + 0.012 * i;
    const FingerContact& contact = tool.tick({{0, 0, 0.008}, turned({0, 1, 0}, angle)});
    largest_step = std::max(largest_step, (contact.t_H_W - last).norm());
    last = contact.t_H_W;
    const double a = angle * EIGEN_PI / 180, lowest = 0.02 * std::abs(std::sin(a)) + 0.01 * std::cos(a);
    EXPECT_NEAR(contact.f_H_W.z(), kHandle * (lowest - 0.008), 1e-6) << angle;
    force = std::max(force, contact.f_H_W.norm());
  }
  EXPECT_LT(largest_step, 0.03 * force * 0.02) << "of the torque on an edge";
}

// Oracle: Coulomb, by the circle of friction; within 0.5 %.
TEST(Xfca, SticksAndSlipsAsCoulombSays) {
  OneTool tool(xfcaWorld(kBlock, slab("rough")));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  const double pressure = 2;
  tool.rest({{0, 0, 0.008}, Quat::Identity()}, 50);
  double largest = 0, last = 0;
  for (int i = 1; i <= 4000; ++i) {
    const FingerContact& contact = tool.tick({{1e-6 * i * 0.6, 1e-6 * i * 0.8, 0.008}, Quat::Identity()});
    last = contact.f_H_W.head<2>().norm();
    largest = std::max(largest, last);
    if (i < 900) {
      EXPECT_EQ(contact.mode, ContactMode::kStick) << i;
      EXPECT_NEAR(last, 1e-6 * i * kHandle, 1e-6);
    }
  }
  EXPECT_NEAR(largest, 0.5 * pressure, 0.005 * pressure);
  EXPECT_NEAR(last, 0.4 * pressure, 0.005 * pressure);
}

// Oracle: the steady lag of the fraction rule is mu d + v B / k, at any rate of the hand.
TEST(Xfca, ViscosityAddsAForceProportionalToSpeed) {
  for (const double speed : {0.02, 0.04, 0.08}) {
    OneTool tool(xfcaWorld(kBall, slab("rough"), R"(<xfca viscosity="5"/>)"));
    tool.tick({{0, 0, 0.02}, Quat::Identity()});
    FingerContact contact;
    for (int i = 0; i < 1000; ++i) contact = tool.tick({{1e-3 * speed * i, 0, 0.008}, Quat::Identity()});
    EXPECT_NEAR(-contact.f_H_W.x(), 0.4 * 2 + 5 * speed, 1e-3) << speed;
  }
}

// Oracle: statics. A ball in a groove of two walls at 45 degrees: each bears depth * k / (2 cos 45).
TEST(Xfca, EachWallOfAGrooveBearsItsShare) {
  const auto wall = [](const std::string& name, int side) {
    return "<body name=\"" + name + R"(" fixed="true" material="smooth" pos=")" + (side < 0 ? "-" : "") +
           "0.0353553390593 0 -0.0353553390593" + R"(" euler_deg="0 )" + std::to_string(-45 * side) +
           R"( 0"><haptic><box size="0.2 0.2 0.1"/></haptic></body>)";
  };
  OneTool tool(xfcaWorld(kBall, wall("left", -1) + wall("right", 1)));
  const double bottom = 0.01 * std::sqrt(2.0);
  tool.tick({{0, 0, bottom + 0.01}, Quat::Identity()});
  const FingerContact& contact = tool.rest({{0, 0, bottom - 0.002}, Quat::Identity()}, 20);
  EXPECT_NEAR(contact.f_H_W.z(), 2, 1e-6);
  Vec3 left = Vec3::Zero(), right = Vec3::Zero();
  for (const ToolContact& one : tool.all().contactsOf(contact)) (one.body == 0 ? left : right) += one.f_H_W;
  EXPECT_NEAR(left.norm(), 2 / std::sqrt(2.0), 1e-5);
  EXPECT_NEAR(right.norm(), 2 / std::sqrt(2.0), 1e-5);
}

// Walls 60 degrees apart: the handle may be above one of the planes that push. The sum is the spring of the handle, all the
// way across.
TEST(Xfca, ASharpGroovePushesBackTheWholeSpring) {
  const auto wall = [](const std::string& name, double turn, const Vec3& at) {
    return "<body name=\"" + name + R"(" fixed="true" material="smooth" pos=")" + std::to_string(at.x()) + " 0 " +
           std::to_string(at.z()) + R"(" euler_deg="0 )" + std::to_string(turn) +
           R"( 0"><haptic><box size="0.2 0.2 0.04"/></haptic></body>)";
  };
  const Quat left = turned({0, 1, 0}, 60), right = turned({0, 1, 0}, -60);
  OneTool tool(
      xfcaWorld(kBall, wall("left", 60, left * Vec3(0, 0, -0.02)) + wall("right", -60, right * Vec3(0, 0, -0.02))));
  const double bottom = 0.01 / std::cos(EIGEN_PI / 3);
  tool.tick({{0, 0, bottom + 0.01}, Quat::Identity()});
  Vec3 last = tool.rest({{-0.004, 0, bottom - 0.001}, Quat::Identity()}, 20).f_H_W;
  for (int i = 0; i <= 800; ++i) {
    const Vec3 hand(-0.004 + 1e-5 * i, 0, bottom - 0.001);
    const Vec3 force = tool.tick({hand, Quat::Identity()}).f_H_W;
    EXPECT_LT((force - kHandle * (tool.state().X_WT.p - hand)).norm(), 0.01) << i << ": but for the skin";
    EXPECT_LT((force - last).norm(), 0.03) << i;
    last = force;
  }
}

// A block that was pressed, tilted and tilted back is where it was: friction holds it along the surface, not above it.
TEST(Xfca, TiltedThereAndBackItPressesAsBefore) {
  OneTool tool(xfcaWorld(kBlock, slab("rough")));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  const double before = tool.rest({{0, 0, 0.007}, Quat::Identity()}, 20).f_H_W.z();
  for (int i = 0; i <= 600; ++i) tool.tick({{0, 0, 0.007}, turned({0, 1, 0}, i < 300 ? 0.02 * i : 0.02 * (600 - i))});
  EXPECT_NEAR(tool.rest({{0, 0, 0.007}, Quat::Identity()}, 2).f_H_W.z(), before, 1e-6);
  EXPECT_NEAR(tool.state().X_WT.p.z(), 0.01, 3e-6);
}

// Oracle: the tip of a needle at 10 rad/s goes 1 mm in a tick, twice the plate's thickness: it stays on its side.
TEST(Xfca, ANeedleDoesNotTurnThroughAThinPlate) {
  OneTool tool(xfcaWorld(
      R"(<tool stiffness="1000"><box size="0.0005 0.0005 0.2"/></tool>)",
      R"(<body name="plate" fixed="true" material="smooth" pos="0.05 0 -0.05"><haptic><box size="0.0005 0.2 0.3"/></haptic></body>)"));
  tool.rest({{0, 0, 0}, Quat::Identity()}, 5);
  for (int i = 0; i <= 157; ++i) tool.tick({{0, 0, 0}, turned({0, 1, 0}, 0.573 * i)});
  EXPECT_LT(tool.state().X_WT.p.x(), -0.04) << "pushed back by the tip, which is 100 mm from the handle";
}

// Two blocks side by side are one floor. Each pair of parts by itself, as printed, loses it: below the seam the two push
// the ball apart sideways, and nothing pushes it up.
std::pair<double, double> forcesOverASeam(const std::string& settings) {
  const auto block = [](const std::string& name, double x) {
    return "<body name=\"" + name + R"(" fixed="true" material="smooth" pos=")" + std::to_string(x) +
           R"( 0 -0.05"><haptic><box size="0.1 0.4 0.1"/></haptic></body>)";
  };
  OneTool tool(xfcaWorld(R"(<tool stiffness="500"><sphere radius="0.002"/></tool>)",
                         block("left", -0.05) + block("right", 0.05), settings));
  tool.rest({{-0.02, 0, 0.004}, Quat::Identity()}, 10);
  for (int i = 0; i < 100; ++i) tool.tick({{-0.02, 0, 0.004 - 0.0001 * i}, Quat::Identity()});
  double least = 1e9, most = 0;
  for (int i = 0; i <= 800; ++i) {
    const double up = tool.tick({{-0.02 + 5e-5 * i, 0, -0.006}, Quat::Identity()}).f_H_W.z();
    least = std::min(least, up);
    most = std::max(most, up);
  }
  return {least, most};
}

TEST(Xfca, ASeamIsNotFelt) {
  const auto [least, most] = forcesOverASeam("");
  EXPECT_NEAR(least, 500 * 0.008, 1e-6);
  EXPECT_NEAR(most, 500 * 0.008, 1e-6);
}

TEST(Xfca, AsPrintedTheToolFallsIntoTheGap) {
  const auto [least, most] = forcesOverASeam(R"(<xfca printed="true" curvature="0.002"/>)");
  EXPECT_GT(most, 0.9 * 500 * 0.008);
  EXPECT_LT(least, 0.2 * 500 * 0.008);
}

// The sagitta; the print, sqrt(2 r^2 - d^2), is 28.3 mm here and does not vanish with d.
TEST(Xfca, TheStepTowardsTheHandleIsTheHeightOfTheChord) {
  EXPECT_NEAR(stepTowardsHandle(0.02, 0.0005), 6.25e-6, 1e-9);
  EXPECT_NEAR(stepTowardsHandle(0.02, 0), 0, 1e-18);
  EXPECT_NEAR(stepTowardsHandle(0.02, 0.03), 0.02, 1e-18);
}

// As printed, on a convex body: the same force as the whole tool's god-object, while the ball rolls over a cylinder.
TEST(Xfca, AsPrintedHoldsAConvexBody) {
  const std::string rod =
      R"(<body name="rod" fixed="true" material="smooth" euler_deg="90 0 0"><haptic><cylinder radius="0.03" length="0.2"/></haptic></body>)";
  OneTool printed(xfcaWorld(kBall, rod, R"(<xfca printed="true" curvature="0.04"/>)")), whole(xfcaWorld(kBall, rod));
  for (int i = 0; i < 1500; ++i) {
    const double angle = 1e-3 * i, radius = 0.04 + std::max(-0.002, 0.001 - 1e-5 * i);
    const Pose hand{{radius * std::sin(angle), 0, radius * std::cos(angle)}, Quat::Identity()};
    const Vec3 one = printed.tick(hand).f_H_W, other = whole.tick(hand).f_H_W;
    if (i < 400) continue;
    EXPECT_NEAR(one.norm(), 2, 0.01) << i;
    EXPECT_NEAR(other.norm(), 2, 0.005) << i;
  }
}

TEST(Xfca, AHandThatJumpsThroughAPlateLeavesTheToolBehind) {
  OneTool tool(xfcaWorld(
      R"(<tool stiffness="1000"><box size="0.04 0.03 0.02"/></tool>)",
      R"(<body name="plate" fixed="true" material="smooth"><haptic><box size="0.4 0.4 0.0005"/></haptic></body>)"));
  tool.rest({{0, 0, 0.015}, Quat::Identity()}, 10);
  const FingerContact& contact = tool.rest({{0.05, 0.02, -0.3}, turned({1, 1, 0}, 30)}, 500);
  EXPECT_GT(tool.state().X_WT.p.z(), 0.01);
  EXPECT_GT(contact.f_H_W.z(), 7);
  EXPECT_LT(contact.f_H_W.norm(), 8);
}

TEST(Xfca, AToolThatStartsInsideIsPushedOutWithinItsLimits) {
  OneTool tool(xfcaWorld(R"(<tool max_force="5"><box size="0.04 0.04 0.04"/></tool>)", slab()));
  for (int i = 0; i < 50; ++i) {
    const FingerContact& contact = tool.tick({{0, 0, 0.015}, Quat::Identity()});
    ASSERT_LE(contact.f_H_W.norm(), 5 + 1e-9);
    EXPECT_NEAR(contact.f_H_W.z(), 5 * (1 - 1.0 / 4), 1) << i;
  }
  EXPECT_NEAR(tool.state().X_WT.p.z(), 0.02, 3e-6);
}

// A cog is cut into convex pieces; it is dragged around over another one.
TEST(Xfca, ACogIsDraggedOverACog) {
  const std::string cog = R"(<body name="cog" fixed="true" material="rough"><haptic><mesh file=")" PRESA_SOURCE_DIR
                          R"(/config/meshes/cog.obj"/></haptic></body>)";
  OneTool tool(
      xfcaWorld(R"(<tool stiffness="1000"><mesh file=")" PRESA_SOURCE_DIR R"(/config/meshes/cog.obj"/></tool>)", cog));
  Vec3 last = Vec3::Zero();
  double largest = 0, largest_step = 0;
  for (int i = 0; i < 4000; ++i) {
    const double angle = 1e-3 * i, radius = std::max(0.055, 0.09 - 1e-4 * i);
    const Pose hand{{radius * std::cos(angle), radius * std::sin(angle), 0}, Quat::Identity()};
    const Vec3 force = tool.tick(hand).f_H_W;
    if (i > 0) largest_step = std::max(largest_step, (force - last).norm());
    largest = std::max(largest, force.norm());
    last = force;
  }
  std::printf("largest force %.2f N, step %.2f N, late %u\n", largest, largest_step, tool.state().late);
  EXPECT_GT(largest, 1);
  EXPECT_LT(largest, 8);
  EXPECT_LT(largest_step, 2.5) << "a tooth snaps past another";
}

TEST(Xfca, StaysOnASlopeUpToTheAngleOfFriction) { test::expectStickingOnASlope("xfca", kBlock); }

TEST(Xfca, GivesTheBodyTheOppositeOfWhatTheHandFeels) {
  OneTool tool(xfcaWorld(kBlock, slab("rough")));
  test::expectThirdLaw(tool, 1000);
}

}  // namespace
}  // namespace presa::xfca_test
