// A block on a plane, for which everything is known: springs in series, no torque, Coulomb's law.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "framework/core/math/random.h"
#include "tests/support/mesh_file.h"
#include "tests/support/tool_laws.h"

namespace presa::flat_contact_test {
namespace {

using test::OneTool;
using test::slab;
using test::toolWorld;
using test::turned;

constexpr double kHandle = 1000, kContact = 200000;  // [N/m]
constexpr double kSeries = kHandle * kContact / (kHandle + kContact);

const char* const kBlock = R"(<tool stiffness="1000" turn_stiffness="2"><box size="0.04 0.03 0.02"/></tool>)";

// Oracle: the springs of handle and contact in series; 2 % is what the sources allow.
TEST(BlockOnPlane, IsPressedBackByTheSpringsInSeries) {
  OneTool tool(toolWorld(kBlock, slab()));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  for (const double depth : {0.0005, 0.001, 0.002, 0.003}) {
    const Pose hand{{0.003, -0.002, 0.01 - depth}, Quat::Identity()};
    tool.rest(hand, 10);  // it comes at up to 2 m/s
    const std::uint32_t late = tool.state().late;
    const FingerContact& contact = tool.rest(hand, 20);
    EXPECT_NEAR(contact.f_H_W.z(), kSeries * depth, 1e-4 * kSeries * depth) << depth;
    EXPECT_NEAR(contact.f_H_W.head<2>().norm(), 0, 1e-9);
    EXPECT_NEAR(tool.state().depth, kSeries * depth / kContact, 1e-7);
    EXPECT_EQ(tool.state().late, late);
  }
}

// The block is symmetric; its points are not, but all of them are equally deep.
TEST(BlockOnPlane, FeelsNoTorqueBySymmetry) {
  OneTool tool(toolWorld(kBlock, slab()));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  const FingerContact& contact = tool.rest({{0, 0, 0.008}, Quat::Identity()}, 1000);
  EXPECT_NEAR(contact.t_H_W.norm(), 0, 1e-6 * 0.02 * contact.f_H_W.norm() + 1e-6);
}

TEST(BlockOnPlane, StaysWhereItIsForAMinute) {
  for (const char* material : {"smooth", "rough"}) {
    OneTool tool(toolWorld(kBlock, slab(material)));
    tool.tick({{0, 0, 0.02}, Quat::Identity()});
    const Pose hand{{0, 0, 0.008}, turned({1, 2, 3}, 3)};
    tool.rest(hand, 200);
    const Pose before = tool.state().X_WT;
    tool.rest(hand, 60000);
    EXPECT_LT((tool.state().X_WT.p - before.p).norm(), 1e-9) << material;
    EXPECT_LT(tool.state().X_WT.q.angularDistance(before.q), 1e-7) << material;
  }
}

// What the hand feels and what the body gets are the same numbers.
TEST(BlockOnPlane, GivesTheBodyTheOppositeOfWhatTheHandFeels) {
  OneTool tool(toolWorld(kBlock, slab("rough")));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  RandomStream random(1, "third law");
  for (int i = 0; i < 2000; ++i) {
    const Vec3 axis(random.normal(), random.normal(), random.normal());
    const Pose hand{{0.01 * random.uniform(), 0.01 * random.uniform(), random.uniform(0.005, 0.015)},
                    turned(axis, random.uniform(0, 20))};
    const FingerContact& contact = tool.tick(hand);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (const ToolContact& one : tool.all().contactsOf(contact)) {
      const Pose& X_WB = tool.world().scene.bodies[static_cast<std::size_t>(one.body)].X_WB;
      EXPECT_LT((X_WB * one.p_BP - one.p_WP).norm(), 1e-15);
      force += one.f_H_W;
      torque += (X_WB * one.p_BP - hand.p).cross(one.f_H_W);
      EXPECT_LT((one.stiffness * one.stretch_W - one.f_H_W).norm(), 1e-12);
    }
    EXPECT_LT((force - contact.f_H_W).norm(), 1e-12);
    EXPECT_LT((torque - contact.t_H_W).norm(), 1e-12);
    EXPECT_LT(contact.f_H_W.norm(), 8 + 1e-9) << "max_force";
  }
}

// Oracle: Coulomb. Dragged sideways, the block follows the hand by a spring until the force is mu times the pressure.
TEST(BlockOnPlane, SticksAndSlipsAsCoulombSays) {
  OneTool tool(toolWorld(kBlock, slab("rough")));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  const double depth = 0.002, pressure = kSeries * depth;
  tool.rest({{0, 0, 0.01 - depth}, Quat::Identity()}, 50);
  double largest = 0;
  for (int i = 1; i <= 4000; ++i) {
    const FingerContact& contact = tool.tick({{1e-6 * i, 0, 0.01 - depth}, Quat::Identity()});
    const double drag = -contact.f_H_W.x();
    largest = std::max(largest, drag);
    if (1e-6 * i * kSeries < 0.45 * pressure) {
      EXPECT_NEAR(drag, 1e-6 * i * kSeries, 0.02 * pressure) << i;
      EXPECT_EQ(contact.mode, ContactMode::kStick);
    }
    if (i == 4000) {
      EXPECT_NEAR(drag, 0.4 * pressure, 0.01 * pressure);
      EXPECT_EQ(contact.mode, ContactMode::kSlip);
    }
  }
  EXPECT_NEAR(largest, 0.5 * pressure, 0.03 * pressure);
}

TEST(BlockOnPlane, StaysOnASlopeUpToTheAngleOfFriction) { test::expectStickingOnASlope("pointshell", kBlock); }

TEST(BlockOnPlane, HoldsBackTheHandUpToItsLimitAndNoMore) {
  OneTool tool(toolWorld(
      R"(<tool stiffness="1000" max_force="3" max_torque="0.05"><box size="0.04 0.03 0.02"/></tool>)", slab()));
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  double last = 0;
  for (int i = 0; i < 60; ++i) {
    const FingerContact& contact = tool.rest({{0, 0, 0.01 - 0.0005 * i}, Quat::Identity()}, 10);
    EXPECT_LT(contact.f_H_W.norm(), 3);
    EXPECT_GE(contact.f_H_W.norm(), last - 1e-6) << "deeper is never less";
    last = contact.f_H_W.norm();
  }
  EXPECT_GT(last, 2.8);
}

// A ball between its points is flatter by spacing^2 / (8 r): four times as many points, a quarter of the error. Oracle: the
// spring of the handle alone, 1 mm long, for the contact is ten thousand times as stiff.
TEST(BallOnPlane, ConvergesWithTheNumberOfItsPoints) {
  const test::MeshFile ball(makeSphere(0.02, 7), "ball");  // a facet lies within 0.4 um of the ball
  std::vector<double> errors;
  for (const int points : {250, 1000, 4000, 16000}) {
    OneTool tool(toolWorld("<tool turn_stiffness=\"100\" max_torque=\"10\"><mesh file=\"" + ball.path() + "\"/></tool>",
                           slab(),
                           "<pointshell max_points=\"" + std::to_string(points) + "\" stiffness=\"10000000\"/>"));
    tool.tick({{0, 0, 0.03}, Quat::Identity()});
    double sum = 0;
    constexpr int kWays = 40;  // it is turned, so that no point is always lowest
    for (int i = 0; i < kWays; ++i) {
      const Quat turn = turned({std::sin(1.0 * i), std::cos(2.0 * i), std::sin(3.0 * i)}, 50.0 * i);
      tool.rest({{0, 0, 0.03}, turn}, 20);
      sum += std::abs(1 - tool.rest({{0, 0, 0.019}, turn}, 30).f_H_W.z());
    }
    errors.push_back(sum / kWays);
  }
  const double order = std::log(errors.front() / errors.back()) / std::log(16000.0 / 250);
  std::printf("mean error of 1 N with 250 to 16000 points: %.4f %.4f %.4f %.4f N, order %.2f\n", errors[0], errors[1],
              errors[2], errors[3], order);
  EXPECT_GT(order, 0.8) << "in the number of points, twice that in their spacing";
}

TEST(BlockOnPlane, InTheAirFollowsTheHandWithoutForce) {
  OneTool tool(toolWorld(kBlock, slab()));
  for (int i = 0; i < 500; ++i) {
    const Pose hand{{0.001 * i, 0, 0.05 + 0.01 * std::sin(0.1 * i)}, turned({1, 1, 0}, i)};
    const FingerContact& contact = tool.tick(hand);
    EXPECT_EQ(contact.f_H_W.norm() + contact.t_H_W.norm(), 0);
    EXPECT_EQ(contact.mode, ContactMode::kNone);
    EXPECT_LT((tool.state().X_WT.p - hand.p).norm(), 1e-12);
  }
}

// At 2 m/s onto the plane: 2 mm a tick, more than the block would have to sink to be lost.
TEST(BlockOnPlane, IsNotCrossedAtAnySpeedOfAHand) {
  for (const double speed : {0.1, 0.5, 1.0, 2.0}) {
    OneTool tool(toolWorld(kBlock, slab()));
    double z = 0.06;
    for (; z > -0.03; z -= 0.001 * speed) {
      tool.tick({{0, 0, z}, turned({1, 0, 0}, 10)});
      EXPECT_GT(tool.state().X_WT.p.z(), 0.009) << speed;
    }
    EXPECT_LT(tool.state().depth, 0.0005);
  }
}

}  // namespace
}  // namespace presa::flat_contact_test
