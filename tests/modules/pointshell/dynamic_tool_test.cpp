// Tools with mass, against implicit Euler in closed form, and against the tool without mass at rest.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/core/diagnostics/refuse.h"
#include "framework/haptics/virtual_coupling.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/mesh_file.h"
#include "tests/support/one_tool.h"

namespace presa::dynamic_tool_test {
namespace {

using test::OneTool;
using test::slab;
using test::toolWorld;
using test::turned;

constexpr double kMass = 0.2, kPeriod = 1e-3;
const char* const kSettings = R"(<pointshell mass="0.2"/>)";

/// A block whose spring to the hand has this damping.
std::string block(const std::string& attributes = "") {
  return R"(<tool stiffness="1000" turn_stiffness="2" )" + attributes + R"(><box size="0.04 0.03 0.02"/></tool>)";
}

/// Displacement after n ticks of implicit Euler, from rest at 1: (1 + a^2)^(-n/2) cos(n atan a), a = omega h.
double implicitEuler(double omega, int n) {
  const double a = omega * kPeriod;
  return std::pow(1 + a * a, -0.5 * n) * std::cos(n * std::atan(a));
}

// The hand jumps by 1 mm and stays. Tolerance: a tick is in balance within 8e-6 N, 4e-11 m of 0.2 kg.
TEST(DynamicTool, SwingsFreelyAsImplicitEulerSays) {
  OneTool tool(toolWorld(block(), slab(), kSettings));
  const Pose start{{0, 0, 0.3}, Quat::Identity()}, hand{{0.001, 0, 0.3}, Quat::Identity()};
  tool.tick(start);
  const double omega = std::sqrt(1000 / kMass);
  for (int n = 1; n <= 500; ++n) {
    const FingerContact& contact = tool.tick(hand);
    const double left = -0.001 * implicitEuler(omega, n);
    ASSERT_NEAR(tool.state().X_WT.p.x() - hand.p.x(), left, 1e-8) << n;
    ASSERT_NEAR(contact.f_H_W.x(), 1000 * left, 2e-5) << "the hand feels the spring";
    ASSERT_EQ(contact.mode, ContactMode::kNone);
  }
}

TEST(DynamicTool, TurnsFreelyAsImplicitEulerSays) {
  OneTool tool(toolWorld(block(), slab(), kSettings));
  tool.tick({{0, 0, 0.3}, Quat::Identity()});
  const Pose hand{{0, 0, 0.3}, turned({0, 0, 1}, 3)};
  const double inertia = kMass / 12 * (0.04 * 0.04 + 0.03 * 0.03), omega = std::sqrt(2 / inertia);
  for (int n = 1; n <= 200; ++n) {
    const FingerContact& contact = tool.tick(hand);
    const double left = 3 * EIGEN_PI / 180 * implicitEuler(omega, n);
    ASSERT_NEAR(turnBetween(tool.state().X_WT.q, hand.q).z(), left, 1e-6) << n;
    ASSERT_NEAR(contact.t_H_W.z(), -2 * left, 4e-6);
  }
}

// A club held at its end: the hand feels no less than the work that it does, and everything comes to rest.
TEST(DynamicTool, HeldAwayFromItsCentreOfMassComesToRestAndGivesNoEnergy) {
  OneTool tool(toolWorld(
      R"(<tool stiffness="1000" turn_stiffness="5" damping="20" turn_damping="0.2" pos="0.02 0 0.1"><box size="0.02 0.02 0.2"/></tool>)",
      R"(<body name="far" fixed="true" material="smooth" pos="3 0 0"><haptic><sphere radius="0.01"/></haptic></body>)",
      kSettings));
  double energy = 0;
  Pose last{Vec3::Zero(), Quat::Identity()};
  tool.tick(last);
  for (int i = 1; i <= 6000; ++i) {
    const double t = std::min(1.0, i * kPeriod);
    const Pose hand{{0.02 * std::sin(20 * t), 0.01 * std::sin(13 * t), 0}, turned({1, 2, 3}, 10 * std::sin(9 * t))};
    const FingerContact& contact = tool.tick(hand);
    energy += contact.f_H_W.dot(hand.p - last.p) + contact.t_H_W.dot(turnBetween(last.q, hand.q));
    last = hand;
  }
  EXPECT_LT(energy, 0);
  EXPECT_LT((tool.state().X_WT.p - last.p).norm(), 1e-6);
  EXPECT_LT(tool.state().X_WT.q.angularDistance(last.q), 1e-5);
  EXPECT_LT(tool.tick(last).f_H_W.norm(), 1e-3);
}

// At rest nothing of the mass is left.
TEST(DynamicTool, AtRestInContactIsWhereTheStaticOneIs) {
  const std::string tool = block(R"(damping="20" turn_damping="0.02")");
  OneTool with(toolWorld(tool, slab(), kSettings)), without(toolWorld(tool, slab()));
  const Pose above{{0, 0, 0.02}, Quat::Identity()}, hand{{0.003, -0.002, 0.008}, turned({1, 2, 3}, 3)};
  with.tick(above), without.tick(above);
  const FingerContact &one = with.rest(hand, 3000), &other = without.rest(hand, 3000);
  EXPECT_LT((one.f_H_W - other.f_H_W).norm(), 1e-4);
  EXPECT_LT((one.t_H_W - other.t_H_W).norm(), 1e-5);
  EXPECT_LT((with.state().X_WT.p - without.state().X_WT.p).norm(), 1e-7);
  EXPECT_GT(one.f_H_W.z(), 1);
  EXPECT_LT(with.state().f_H_W.norm(), 1e-4);
}

// At 0.5 m/s onto the slab, with its own momentum: it stays above, and comes to rest.
TEST(DynamicTool, IsStoppedByASlabAndNeitherAllocatesNorLocks) {
  OneTool tool(toolWorld(block(), slab("rough"), kSettings));
  double z = 0.06;
  tool.tick({{0, 0, z}, turned({1, 0, 0}, 10)});
  const RealTimeGuard guard;
  for (; z > 0.006; z -= 0.0005) {
    tool.tick({{0, 0, z}, turned({1, 0, 0}, 10)});
    EXPECT_GT(tool.state().X_WT.p.z(), 0.009);
  }
  Vec3 last = tool.rest({{0, 0, z}, turned({1, 0, 0}, 10)}, 2000).f_H_W;
  EXPECT_EQ(guard.violations(), 0) << guard.first();
  EXPECT_LT((tool.tick({{0, 0, z}, turned({1, 0, 0}, 10)}).f_H_W - last).norm(), 1e-4);
  EXPECT_GT(last.z(), 3);
}

// Closed, but flat: two squares back to back.
TEST(DynamicTool, NeedsAVolume) {
  TriMesh flat;
  flat.vertices = {{0, 0, 0}, {0.05, 0, 0}, {0.05, 0.05, 0}, {0, 0.05, 0}};
  flat.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {1, 3, 2}};
  const test::MeshFile file(flat, "flat_tool");
  try {
    OneTool tool(toolWorld("<tool><mesh file=\"" + file.path() + "\"/></tool>", slab(), kSettings));
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.diagnostics().text();
    EXPECT_NE(text.find("E596"), std::string::npos) << text;
    EXPECT_NE(text.find("mass=\"0\""), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace presa::dynamic_tool_test
