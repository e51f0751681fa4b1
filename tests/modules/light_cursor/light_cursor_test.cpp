// A light tool in six degrees of freedom, against bodies for which everything is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "framework/haptics/virtual_coupling.h"
#include "tests/support/tool_laws.h"

namespace presa::light_cursor_test {
namespace {

using test::OneTool;
using test::slab;
using test::turned;

std::shared_ptr<const World> cursorWorld(const std::string& tool, const std::string& bodies,
                                         const std::string& settings = "") {
  return test::toolWorld(tool, bodies, settings, "light_cursor");
}

constexpr double kHandle = 1000, kPoint = 200000;  // [N/m]
constexpr double kSeries = kHandle * 4 * kPoint / (kHandle + 4 * kPoint);
const char* const kBlock = R"(<tool stiffness="1000" turn_stiffness="2"><box size="0.04 0.03 0.02"/></tool>)";

// Oracle: the spring of the handle in series with those of four corners.
TEST(LightCursor, ABlockIsPressedBackByTheSpringsInSeries) {
  OneTool tool(cursorWorld(kBlock, slab()));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  for (const double depth : {0.0005, 0.001, 0.002, 0.003}) {
    const FingerContact& contact = tool.rest({{0.003, -0.002, 0.01 - depth}, Quat::Identity()}, 200);
    EXPECT_NEAR(contact.f_H_W.z(), kSeries * depth, 1e-6 * kSeries * depth) << depth;
    EXPECT_NEAR(contact.t_H_W.norm(), 0, 1e-9);
    EXPECT_NEAR(tool.state().depth, kSeries * depth / (4 * kPoint), 1e-9);
  }
  EXPECT_EQ(tool.state().late, 0U);
}

// Oracle: a block whose handle leans stays flat while the torque of the handle fits under its base, and feels all of it.
TEST(LightCursor, ALeaningHandleFeelsTheTorqueOfTheFlatBlock) {
  OneTool tool(cursorWorld(kBlock, slab()));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  const double lean = 0.3;  // degrees: 10.5 mN m, the base bears 2 N x 20 mm
  const FingerContact& contact = tool.rest({{0, 0, 0.008}, turned({0, 1, 0}, lean)}, 300);
  EXPECT_NEAR(contact.t_H_W.y(), -2 * lean * EIGEN_PI / 180, 2e-4);
  EXPECT_LT(tool.state().X_WT.q.angularDistance(Quat::Identity()), 1e-4);
}

// A thin rod held at its end is a line that several bodies hold at once. Statics of height w and tilt phi over two balls, each
// a spring: F_i = -K (w + x_i phi), F_1 + F_2 = k (w + depth), F_1 x_1 + F_2 x_2 = c (phi + lean).
TEST(LightCursor, ARodOnTwoBallsFeelsWhereEachOfThemIs) {
  const auto ball = [](const std::string& name, double x) {
    return "<body name=\"" + name + "\" fixed=\"true\" material=\"smooth\" pos=\"" + std::to_string(x) +
           " 0 -0.01\"><haptic><sphere radius=\"0.01\"/></haptic></body>";
  };
  constexpr double kRod = 0.001, kDepth = 0.002, kTurn = 2, kNear = 0.05, kFar = 0.1;
  OneTool tool(cursorWorld(
      R"(<tool pos="0 0 0.08" stiffness="1000" turn_stiffness="2"><capsule radius="0.001" length="0.158"/></tool>)",
      ball("near", kNear) + ball("far", kFar)));
  const Quat level = turned({0, 1, 0}, 90);  // the rod points along x
  tool.tick({{0, 0, 0.02}, level});
  for (const double degrees : {3.5, 4.3, 5.0}) {
    const double lean = degrees * EIGEN_PI / 180;
    Eigen::Matrix2d springs{{kHandle + 2 * kPoint, kPoint * (kNear + kFar)},
                            {kPoint * (kNear + kFar), kTurn + kPoint * (kNear * kNear + kFar * kFar)}};
    const Eigen::Vector2d rod = springs.inverse() * Eigen::Vector2d(-kHandle * kDepth, -kTurn * lean);
    const auto force = [&](double x) { return -kPoint * (rod[0] + x * rod[1]); };
    const FingerContact& contact = tool.rest({{0, 0, kRod - kDepth}, turned({0, 1, 0}, degrees) * level}, 500);
    ASSERT_EQ(tool.all().contactsOf(contact).size(), 2U);
    for (const ToolContact& one : tool.all().contactsOf(contact)) {
      const double x = one.body == 0 ? kNear : kFar;
      EXPECT_NEAR(one.f_H_W.z(), force(x), 0.002 * kHandle * kDepth) << degrees;
      EXPECT_NEAR(one.p_WP.x(), x, 1e-5);
    }
    EXPECT_NEAR(contact.f_H_W.z(), force(kNear) + force(kFar), 0.002 * kHandle * kDepth);
    EXPECT_NEAR(contact.t_H_W.y(), -kNear * force(kNear) - kFar * force(kFar), 0.002 * kTurn * lean);
    EXPECT_NEAR(contact.t_H_W.x(), 0, 1e-6) << "about the rod's own axis";
  }
}

TEST(LightCursor, StaysWhereItIs) {
  for (const char* material : {"smooth", "rough"}) {
    OneTool tool(cursorWorld(kBlock, slab(material)));
    tool.tick({{0, 0, 0.02}, Quat::Identity()});
    const Pose hand{{0, 0, 0.008}, turned({1, 2, 3}, 3)};
    tool.rest(hand, 500);
    const Pose before = tool.state().X_WT;
    const Vec3 force = tool.rest(hand, 1).f_H_W;
    tool.rest(hand, 20000);
    EXPECT_LT((tool.state().X_WT.p - before.p).norm(), 1e-9) << material;
    EXPECT_LT(tool.state().X_WT.q.angularDistance(before.q), 1e-7) << material;
    EXPECT_LT((tool.rest(hand, 1).f_H_W - force).norm(), 1e-6) << material;
  }
}

// Oracle: Coulomb. Slowly pulled, so light a body sticks and slips by turns, as it must with inertia; its peaks are static
// friction. Pulled fast, it slides.
TEST(LightCursor, SticksAndSlipsAsCoulombSays) {
  OneTool tool(cursorWorld(kBlock, slab("rough")));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  const double pressure = kSeries * 0.002;
  tool.rest({{0, 0, 0.008}, Quat::Identity()}, 200);
  double largest = 0;
  for (int i = 1; i <= 4000; ++i) {
    const FingerContact& contact = tool.tick({{1e-6 * i, 0, 0.008}, Quat::Identity()});
    largest = std::max(largest, -contact.f_H_W.x());
    if (i < 900) {
      EXPECT_EQ(contact.mode, ContactMode::kStick) << i;
    }
  }
  EXPECT_NEAR(largest, 0.5 * pressure, 0.005 * pressure);
  double mean = 0;
  for (int i = 1; i <= 400; ++i) {
    const double drag = -tool.tick({{0.004 + 1e-4 * i, 0, 0.008}, Quat::Identity()}).f_H_W.x();
    mean += i > 200 ? drag / 200 : 0;
  }
  EXPECT_NEAR(mean, 0.4 * pressure, 0.005 * pressure);
}

// Oracle of the sources: no force in the air, where the tool lags by mass times acceleration over stiffness.
TEST(LightCursor, InTheAirLagsByItsInertiaWithoutForce) {
  OneTool tool(cursorWorld(R"(<tool stiffness="1000" damping="0"><sphere radius="0.01"/></tool>)", slab(),
                           R"(<light_cursor mass="0.005"/>)"));
  const double acceleration = 20;
  for (int i = 0; i < 200; ++i) {
    const double t = 1e-3 * i;
    const FingerContact& contact = tool.tick({{0.5 * acceleration * t * t, 0, 0.1}, Quat::Identity()});
    EXPECT_EQ(contact.f_H_W.norm(), 0);
    if (i < 100) continue;
    // half a step of the implicit method's own, on top
    EXPECT_NEAR(0.5 * acceleration * t * t - tool.state().X_WT.p.x(), 0.005 * acceleration / 1000, 2e-5) << i;
  }
}

/// A square hole for a peg of 20 mm, in a block of four walls and a floor.
std::string hole(double clearance, const std::string& material) {
  const double inner = 0.01 + clearance / 2, thick = 0.02;
  std::string bodies;
  const auto wall = [&](const std::string& name, double x, double y, double sx, double sy) {
    bodies += "<body name=\"" + name + "\" fixed=\"true\" material=\"" + material + "\" pos=\"" + std::to_string(x) +
              " " + std::to_string(y) + " 0.01\"><haptic><box size=\"" + std::to_string(sx) + " " + std::to_string(sy) +
              " 0.02\"/></haptic></body>";
  };
  const double at = inner + thick / 2, wide = 2 * (inner + thick);
  wall("left", -at, 0, thick, wide);
  wall("right", at, 0, thick, wide);
  wall("near", 0, -at, 2 * inner, thick);
  wall("far", 0, at, 2 * inner, thick);
  return bodies + "<body name=\"floor\" fixed=\"true\" material=\"" + material +
         R"(" pos="0 0 -0.01"><haptic><box size="0.2 0.2 0.02"/></haptic></body>)";
}

struct Wobbled {
  double largest = 0, largest_step = 0, deepest = 0, energy = 0;
};

Wobbled wobble(double clearance, const std::string& material, int ticks) {
  OneTool tool(cursorWorld(R"(<tool stiffness="1000" turn_stiffness="2"><box size="0.02 0.02 0.06"/></tool>)",
                           hole(clearance, material)));
  tool.tick({{0, 0, 0.06}, Quat::Identity()});
  for (int i = 0; i < 1000; ++i) tool.tick({{0, 0, 0.06 - 0.035 * i / 1000}, Quat::Identity()});
  Vec3 last_force = tool.rest({{0, 0, 0.025}, Quat::Identity()}, 200).f_H_W;
  Wobbled result;
  Pose last{{0, 0, 0.025}, Quat::Identity()};
  for (int i = 0; i < ticks; ++i) {
    const double t = 1e-3 * i;
    const Pose hand{{0, 0, 0.025},
                    turned({std::cos(t), std::sin(t), 0}, 20 * std::min(1.0, t) * std::sin(2 * std::numbers::pi * t))};
    const FingerContact& contact = tool.tick(hand);
    result.energy += contact.f_H_W.dot(hand.p - last.p) + contact.t_H_W.dot(turnBetween(last.q, hand.q));
    result.largest = std::max(result.largest, contact.f_H_W.norm());
    result.largest_step = std::max(result.largest_step, (contact.f_H_W - last_force).norm());
    result.deepest = std::max(result.deepest, tool.state().depth);
    last_force = contact.f_H_W;
    last = hand;
  }
  EXPECT_LT(tool.state().X_WT.p.z(), 0.0302) << "it is in";
  return result;
}

TEST(LightCursor, APegWobblesInItsHoleWithoutGivingEnergy) {
  for (const double clearance : {0.001, 0.0002, 0.00005}) {
    for (const char* material : {"smooth", "rough"}) {
      const Wobbled w = wobble(clearance, material, 10000);
      std::printf("%.2f mm, %s: force %.2f N, step %.2f N, depth %.0f um, energy %.4f J\n", 1e3 * clearance, material,
                  w.largest, w.largest_step, 1e6 * w.deepest, w.energy);
      EXPECT_LT(w.largest, 8);
      EXPECT_LT(w.largest_step, 1);
      EXPECT_LT(w.deepest, 2.5e-4);
      EXPECT_LT(w.energy, 0.001);
    }
  }
}

TEST(LightCursor, ACogIsDraggedThroughACog) {
  const std::string cog = R"(<body name="cog" fixed="true" material="rough"><haptic><mesh file=")" PRESA_SOURCE_DIR
                          R"(/config/meshes/cog.obj"/></haptic></body>)";
  OneTool tool(cursorWorld(R"(<tool stiffness="1000" turn_stiffness="1"><mesh file=")" PRESA_SOURCE_DIR
                           R"(/config/meshes/cog.obj"/></tool>)",
                           cog));
  double largest = 0, deepest = 0;
  for (int i = 0; i < 4000; ++i) {
    const double angle = 1e-3 * i, radius = std::max(0.055, 0.09 - 1e-4 * i);
    const FingerContact& contact =
        tool.tick({{radius * std::cos(angle), radius * std::sin(angle), 0}, Quat::Identity()});
    largest = std::max(largest, contact.f_H_W.norm());
    deepest = std::max(deepest, tool.state().depth);
  }
  std::printf("largest force %.2f N, depth %.0f um, late %u, coarse %u\n", largest, 1e6 * deepest, tool.state().late,
              tool.state().coarse);
  EXPECT_GT(largest, 1);
  EXPECT_LT(largest, 8);
  EXPECT_LT(deepest, 1e-3);
}

TEST(LightCursor, AHandThatJumpsThroughAPlateLeavesTheToolBehind) {
  OneTool tool(cursorWorld(
      kBlock,
      R"(<body name="plate" fixed="true" material="smooth"><haptic><box size="0.4 0.4 0.0005"/></haptic></body>)"));
  tool.rest({{0, 0, 0.015}, Quat::Identity()}, 10);
  const FingerContact& contact = tool.rest({{0.05, 0.02, -0.3}, turned({1, 1, 0}, 30)}, 500);
  EXPECT_GT(tool.state().X_WT.p.z(), 0.009);
  EXPECT_GT(contact.f_H_W.z(), 7);
  EXPECT_LT(contact.f_H_W.norm(), 8);
}

TEST(LightCursor, AToolThatStartsInsideIsPushedOutWithinItsLimits) {
  OneTool tool(cursorWorld(R"(<tool max_force="5"><box size="0.04 0.04 0.04"/></tool>)", slab()));
  for (int i = 0; i < 200; ++i) {
    const FingerContact& contact = tool.tick({{0, 0, 0.015}, Quat::Identity()});
    ASSERT_LE(contact.f_H_W.norm(), 5 + 1e-9) << i;
    ASSERT_TRUE(std::isfinite(contact.t_H_W.norm()));
  }
  EXPECT_NEAR(tool.state().X_WT.p.z(), 0.02, 1e-4);
}

// A wall that comes at 1 m/s takes the tool along, up to the limits of the handle.
TEST(LightCursor, ABodyThatMovesIntoARestingToolPushesIt) {
  OneTool tool(cursorWorld(
      kBlock, R"(<body name="wall" material="smooth" pos="0 0 -0.06"><haptic><box size="0.2 0.2 0.1"/></haptic>
    <physics mass="1"><box size="0.2 0.2 0.1"/></physics></body>)"));
  const Pose hand{{0, 0, 0.02}, Quat::Identity()};
  tool.rest(hand, 5);
  for (int i = 0; i < 50; ++i) {
    BodyMotion& wall = tool.objects().bodies[0];
    wall.X_WB_begin.p.z() = wall.X_WB_end.p.z() = -0.06 + 0.001 * i;
    const FingerContact& contact = tool.tick(hand);
    ASSERT_LT(contact.f_H_W.norm(), 8);
    const double below = wall.X_WB_end.p.z() + 0.05 - (tool.state().X_WT.p.z() - 0.01);
    EXPECT_LT(below, 2e-4) << i;
  }
  EXPECT_GT(tool.state().X_WT.p.z(), 0.045);
}

// Touched from above long ago, a block that comes from below is pushed back down.
TEST(LightCursor, RemembersNoPlaneOfLongAgo) {
  OneTool tool(cursorWorld(
      kBlock,
      R"(<body name="box" fixed="true" material="smooth"><haptic><box size="0.06 0.06 0.06"/></haptic></body>)"));
  tool.rest({{0, 0, 0.05}, Quat::Identity()}, 5);
  tool.rest({{0, 0, 0.039}, Quat::Identity()}, 50);
  for (const Vec3& p : {Vec3(0, 0, 0.08), Vec3(0.2, 0, 0), Vec3(0.2, 0, -0.1), Vec3(0, 0, -0.08)})
    tool.rest({p, Quat::Identity()}, 300);
  const FingerContact& contact = tool.rest({{0, 0, -0.038}, turned({1, 1, 0}, 40)}, 200);
  EXPECT_LT(tool.state().X_WT.p.z(), -0.038);
  EXPECT_LT(contact.f_H_W.z(), -1);
}

// Oracle: mu F times the mean distance of the corners, 25 mm, in each radian.
TEST(LightCursor, ASpinOfTenRadiansASecondCostsEnergy) {
  OneTool tool(cursorWorld(R"(<tool turn_stiffness="2"><box size="0.04 0.03 0.02"/></tool>)", slab("rough")));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  Pose last{{0, 0, 0.008}, Quat::Identity()};
  tool.rest(last, 50);
  double energy = 0;
  for (int i = 1; i <= 3000; ++i) {
    const Pose hand{{0, 0, 0.008}, turned({0, 0, 1}, 0.01 * i * 180 / EIGEN_PI)};
    energy += tool.tick(hand).t_H_W.dot(turnBetween(last.q, hand.q));
    last = hand;
  }
  EXPECT_NEAR(energy, -30 * 0.4 * 2 * 0.025, 0.05);
}

TEST(LightCursor, StaysOnASlopeUpToTheAngleOfFriction) { test::expectStickingOnASlope("light_cursor", kBlock); }

TEST(LightCursor, GivesTheBodyTheOppositeOfWhatTheHandFeels) {
  OneTool tool(cursorWorld(kBlock, slab("rough")));
  test::expectThirdLaw(tool, 1000);
}

}  // namespace
}  // namespace presa::light_cursor_test
