// A tool that a button puts down and picks up again: held as it lies, without a jump in force.
#include <gtest/gtest.h>

#include "tests/support/one_tool.h"

namespace presa::put_down_test {
namespace {

using test::OneTool;
using test::slab;
using test::toolWorld;
using test::turned;

constexpr double kHalf = 0.01, kStiffness = 1000;
/// A cube of 20 mm.
std::shared_ptr<const World> cube(const std::string& attribute = "put_down=\"1\"") {
  return toolWorld(
      "<tool stiffness=\"1000\" turn_stiffness=\"1\" " + attribute + "><box size=\"0.02 0.02 0.02\"/></tool>", slab());
}
/// The handle above the slab, with the cube this deep in it.
Pose pressed(double depth) { return {{0, 0, kHalf - depth}, Quat::Identity()}; }

/// A press of the button, and time for the force to fade.
void press(OneTool& tool, const Pose& X_WH) {
  tool.buttons = 2;
  tool.rest(X_WH, 5);
  tool.buttons = 0;
  tool.rest(X_WH, 60);
}

TEST(PutDown, LiesWhereItWasWhileTheHandleMovesFreely) {
  OneTool tool(cube());
  tool.rest(pressed(0.002), 20);
  const Pose before = tool.state().X_WT;
  press(tool, pressed(0.002));
  EXPECT_TRUE(tool.state().lies);
  const FingerContact& away = tool.rest({{0.1, 0, 0.2}, turned({0, 1, 0}, 40)}, 20);
  EXPECT_TRUE(away.f_H_W.isZero());
  EXPECT_TRUE(away.t_H_W.isZero());
  EXPECT_EQ(away.contact_count, 0U);
  EXPECT_EQ((tool.state().X_WT.p - before.p).norm(), 0);
  EXPECT_TRUE(tool.state().alive) << "it is still there to be seen";
}

// The force of 2 N (2 mm at 1000 N/m) falls by a fiftieth of it each tick of the fade.
TEST(PutDown, FadesWithoutAJump) {
  OneTool tool(cube());
  double last = tool.rest(pressed(0.002), 20).f_H_W.norm();
  EXPECT_NEAR(last, 0.002 * kStiffness, 0.02);
  tool.buttons = 2;
  for (int i = 0; i < 60; ++i) {
    const double now = tool.tick(pressed(0.002)).f_H_W.norm();
    EXPECT_LE(std::abs(now - last), 0.021 * 0.002 * kStiffness);
    last = now;
  }
  EXPECT_EQ(last, 0);
}

// Gripped aside and askew, it is held so: no force at first, then the spring's own, at the handle with its lever.
TEST(PickedUp, IsHeldAsItLiesWithoutAJump) {
  OneTool tool(cube());
  tool.rest(pressed(0.002), 20);
  press(tool, pressed(0.002));
  const Pose lies = tool.state().X_WT;
  Pose grip{{0.004, -0.003, 0.03}, turned({1, 2, 0}, 25)};
  tool.rest(grip, 10);
  tool.buttons = 2;
  const FingerContact& first = tool.tick(grip);
  EXPECT_FALSE(tool.state().lies);
  // the cube lay 2 N / 200 kN/m = 10 um deep: the spring feels no more than that
  EXPECT_LT(first.f_H_W.norm(), 1.1e-5 * kStiffness);
  EXPECT_LT((tool.state().X_WT.p - lies.p).norm(), 2e-5);
  EXPECT_LT(tool.state().X_WT.q.angularDistance(lies.q), 1e-6);
  tool.buttons = 0;
  tool.rest(grip, 20);
  // 1.5 mm down in steps of 0.05 mm: each adds at most 0.05 N and what it turns
  double last = tool.tick(grip).f_H_W.norm();
  for (int i = 0; i < 30; ++i) {
    grip.p.z() -= 5e-5;
    const FingerContact& now = tool.tick(grip);
    EXPECT_LT(std::abs(now.f_H_W.norm() - last), 1.2 * 5e-5 * kStiffness);
    last = now.f_H_W.norm();
  }
  EXPECT_NEAR(last, 0.0015 * kStiffness, 0.02);
  const FingerContact& held = tool.tick(grip);
  // it acts at the cube, which lies beside the handle
  EXPECT_NEAR(held.t_H_W.y(), -(lies.p - grip.p).x() * held.f_H_W.z(), 0.03 * held.f_H_W.z() * 0.01);
}

TEST(PickedUp, OnlyFromNearIt) {
  OneTool tool(cube());
  tool.rest(pressed(0.001), 20);
  press(tool, pressed(0.001));
  const Pose far{{0.03, 0, kHalf}, Quat::Identity()};  // 20 mm from its side
  press(tool, far);
  EXPECT_TRUE(tool.state().lies);
  const Pose near{{0.02, 0, kHalf}, Quat::Identity()};  // 10 mm
  press(tool, near);
  EXPECT_FALSE(tool.state().lies);
}

TEST(PutDown, IsNothingToAToolWithoutIt) {
  OneTool plain(cube("")), able(cube());
  plain.buttons = 2;
  for (int i = 0; i < 30; ++i) {
    const Pose at = pressed(0.0001 * i);
    const FingerContact &a = plain.tick(at), &b = able.tick(at);
    EXPECT_EQ(a.f_H_W, b.f_H_W);
    EXPECT_EQ(a.t_H_W, b.t_H_W);
  }
}

}  // namespace
}  // namespace presa::put_down_test
