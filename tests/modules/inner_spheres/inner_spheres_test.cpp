// Overlap volumes against closed forms, and tools that rest on them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "framework/core/diagnostics/refuse.h"
#include "framework/geometry/sphere_packing.h"
#include "tests/support/mesh_file.h"
#include "tests/support/one_tool.h"

namespace presa::inner_spheres_test {
namespace {

using test::OneTool;
using test::turned;

constexpr double kPi = std::numbers::pi;

std::shared_ptr<const World> spheresWorld(const std::string& tool, const std::string& bodies,
                                          const std::string& settings = "") {
  return test::toolWorld(tool, bodies, settings, "inner_spheres");
}

// Oracle: the volume by slices, whose discs are known.
TEST(InnerSpheres, OverlapIsThatOfTheSlices) {
  const double r = 0.02, q = 0.013;
  for (const double apart : {0.001, 0.007, 0.0071, 0.015, 0.025, 0.0329, 0.033, 0.05}) {
    constexpr int kSlices = 200000;
    double volume = 0;
    for (int i = 0; i < kSlices; ++i) {
      const double x = -r + 2 * r * (i + 0.5) / kSlices;  // along the line of centres
      const double of_r = r * r - x * x, of_q = q * q - (x - apart) * (x - apart);
      volume += kPi * std::max(0.0, std::min(of_r, of_q)) * 2 * r / kSlices;
    }
    EXPECT_NEAR(overlapVolume(r, q, apart), volume, 1e-5 * r * r * r) << apart;
    const double h = 1e-7;
    const double slope = (overlapVolume(r, q, apart - h) - overlapVolume(r, q, apart + h)) / (2 * h);
    if (std::abs(apart - 0.033) > 1e-6 && std::abs(apart - 0.007) > 2e-4) {
      EXPECT_NEAR(overlapArea(r, q, apart), slope, 1e-6 * kPi * q * q) << apart;
    }
  }
}

TEST(InnerSpheres, PackedSpheresStayInsideAndApart) {
  const Vec3 half(0.02, 0.015, 0.01);
  const auto depth = [&](const Vec3& p) { return (half - p.cwiseAbs()).minCoeff(); };
  const std::vector<InnerSphere> spheres = packSpheres(depth, {-half, half}, 500);
  ASSERT_GT(spheres.size(), 300U);
  EXPECT_NEAR(spheres.front().radius, 0.01, 1e-4) << "the largest one fills the thickness";
  double volume = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    EXPECT_LE(spheres[i].radius, depth(spheres[i].centre) + 1e-15);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((spheres[i].centre - spheres[j].centre).norm(), spheres[i].radius + spheres[j].radius - 1e-15);
    }
    volume += 4 * kPi / 3 * std::pow(spheres[i].radius, 3);
  }
  const double filled = volume / (8 * half.prod());
  std::printf("%zu spheres fill %.1f %%\n", spheres.size(), 100 * filled);
  EXPECT_GT(filled, 0.7);
}

// Oracle: the spring of the handle balances kappa times the closed form.
TEST(InnerSpheres, TwoSpheresPushWithTheirOverlap) {
  OneTool tool(spheresWorld(
      R"(<tool stiffness="1000"><sphere radius="0.01"/></tool>)",
      R"(<body name="ball" fixed="true" material="smooth"><haptic><sphere radius="0.02"/></haptic></body>)"));
  tool.tick({{0, 0, 0.05}, Quat::Identity()});
  for (int i = 0; i < 400; ++i) tool.tick({{0, 0, 0.05 - 0.000055 * i}, Quat::Identity()});
  const double hand = 0.028;
  const FingerContact& contact = tool.rest({{0, 0, hand}, Quat::Identity()}, 50);
  double low = hand, high = 0.03;  // distance at which both forces are equal
  for (int i = 0; i < 100; ++i) {
    const double s = (low + high) / 2;
    (1e8 * overlapVolume(0.01, 0.02, s) > 1000 * (s - hand) ? low : high) = s;
  }
  EXPECT_NEAR(tool.state().X_WT.p.z(), low, 1e-8);
  EXPECT_NEAR(contact.f_H_W.z(), 1000 * (low - hand), 1e-5);
  EXPECT_NEAR(contact.t_H_W.norm(), 0, 1e-9);
  EXPECT_EQ(tool.state().points, 1U);
}

TEST(InnerSpheres, ABlockRestsOnASlabAndIsNotMoved) {
  OneTool tool(spheresWorld(
      R"(<tool stiffness="1000" turn_stiffness="2"><box size="0.04 0.03 0.02"/></tool>)",
      R"(<body name="slab" fixed="true" material="smooth" pos="0 0 -0.01"><haptic><box size="0.08 0.08 0.02"/></haptic></body>)"));
  tool.tick({{0, 0, 0.03}, Quat::Identity()});
  for (int i = 0; i < 500; ++i) tool.tick({{0, 0, 0.03 - 0.000045 * i}, Quat::Identity()});
  const Pose hand{{0, 0, 0.0075}, Quat::Identity()};
  tool.rest(hand, 200);
  const Pose before = tool.state().X_WT;
  const FingerContact& contact = tool.rest(hand, 5000);
  std::printf("height %.3f mm of 10, %.2f N, %u pairs, late %u\n", 1e3 * tool.state().X_WT.p.z(), contact.f_H_W.z(),
              tool.state().points, tool.state().late);
  EXPECT_LT((tool.state().X_WT.p - before.p).norm(), 1e-7);
  EXPECT_NEAR(contact.f_H_W.z(), 1000 * (tool.state().X_WT.p.z() - 0.0075), 1e-6);
  EXPECT_GT(tool.state().X_WT.p.z(), 0.0085);
  EXPECT_LT(tool.state().X_WT.p.z(), 0.01 + 1e-6) << "spheres lie inside";
}

TEST(InnerSpheres, ACogOnACogIsHeldWithinItsLimits) {
  const std::string cog = R"(<body name="cog" fixed="true" material="smooth"><haptic><mesh file=")" PRESA_SOURCE_DIR
                          R"(/config/meshes/cog.obj"/></haptic></body>)";
  OneTool tool(spheresWorld(R"(<tool><mesh file=")" PRESA_SOURCE_DIR R"(/config/meshes/cog.obj"/></tool>)", cog,
                            R"(<inner_spheres count="600" stiffness="1e9"/>)"));
  double largest = 0, energy = 0;
  Vec3 last = Vec3(0.09, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    const double angle = 1e-3 * i, radius = std::max(0.055, 0.09 - 1e-4 * i);
    const Pose hand{{radius * std::cos(angle), radius * std::sin(angle), 0}, Quat::Identity()};
    const FingerContact& contact = tool.tick(hand);
    largest = std::max(largest, contact.f_H_W.norm());
    energy += contact.f_H_W.dot(hand.p - last);
    last = hand.p;
  }
  std::printf("largest force %.2f N, energy %.4f J, late %u, coarse %u\n", largest, energy, tool.state().late,
              tool.state().coarse);
  EXPECT_GT(largest, 0.5);
  EXPECT_LT(largest, 8);
}

// A ball that comes towards a still tool meets it.
TEST(InnerSpheres, ABodyThatMovesIntoARestingToolPushesIt) {
  OneTool tool(
      spheresWorld(R"(<tool><sphere radius="0.01"/></tool>)",
                   R"(<body name="ball" material="smooth" pos="0 0 -0.04"><haptic><sphere radius="0.02"/></haptic>
    <physics mass="1"><sphere radius="0.02"/></physics></body>)"));
  const Pose hand{{0, 0, 0}, Quat::Identity()};
  tool.rest(hand, 5);
  for (int i = 0; i < 150; ++i) {
    BodyMotion& ball = tool.objects().bodies[0];
    ball.X_WB_begin.p.z() = ball.X_WB_end.p.z() = -0.04 + 0.0001 * i;
    tool.tick(hand);
  }
  EXPECT_GT(tool.rest(hand, 5).f_H_W.z(), 2);
}

TEST(InnerSpheres, APlateFillsEvenly) {
  const Vec3 half(0.1, 0.1, 0.002);
  const auto depth = [&](const Vec3& p) { return (half - p.cwiseAbs()).minCoeff(); };
  double left = 0, right = 0;
  for (const InnerSphere& one : packSpheres(depth, {-half, half}, 300)) (one.centre.x() < 0 ? left : right) += 1;
  EXPECT_NEAR(left / (left + right), 0.5, 0.1);
}

// A sheet of a micrometre across the cells of the grid.
TEST(InnerSpheres, AToolTooThinForAnySphereIsRefused) {
  TriMesh sheet = makeBox({0.1, 0.1, 0.000001});
  for (Vec3& v : sheet.vertices) v = turned({1, 2, 0}, 40) * v;
  const test::MeshFile file(sheet, "sheet");
  EXPECT_THROW(OneTool(spheresWorld("<tool><mesh file=\"" + file.path() + "\"/></tool>", test::slab())), InputError);
}

TEST(InnerSpheres, AMeshWithoutAnInsideIsRefused) {
  TriMesh sheet = makeBox({0.1, 0.1, 0.1});
  sheet.triangles.resize(10);
  const test::MeshFile file(sheet, "open");
  try {
    OneTool tool(spheresWorld(R"(<tool><sphere radius="0.01"/></tool>)", file.body("sheet", "smooth")));
    ADD_FAILURE() << "it was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(error.diagnostics().text().find("body 'sheet' is open"), std::string::npos) << error.diagnostics().text();
  }
}

}  // namespace
}  // namespace presa::inner_spheres_test
