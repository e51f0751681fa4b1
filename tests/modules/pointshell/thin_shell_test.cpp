// Open meshes as thin shells: a plate of one layer of triangles, and a mug with an open rim.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/core/diagnostics/refuse.h"
#include "tests/support/mesh_file.h"
#include "tests/support/one_tool.h"

namespace presa::thin_shell_test {
namespace {

using test::OneTool;
using test::toolWorld;
using test::turned;

constexpr double kThick = 0.002, kSeries = 1000.0 * 200000 / 201000;
const char* const kShell = R"(<pointshell shell_thickness="0.002"/>)";
const char* const kBlock = R"(<tool turn_stiffness="2"><box size="0.02 0.016 0.02"/></tool>)";

/// A square of 80 mm at z = 0: one layer of triangles.
TriMesh plate() {
  constexpr int kSide = 4;
  TriMesh mesh;
  for (int j = 0; j <= kSide; ++j) {
    for (int i = 0; i <= kSide; ++i) mesh.vertices.emplace_back(0.02 * i - 0.04, 0.02 * j - 0.04, 0);
  }
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const int a = i + (kSide + 1) * j, b = a + 1, c = a + kSide + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

/// A mug of one layer: a wall of radius 30 mm from z = 0 to 60 mm, a bottom, no lid.
TriMesh mug() {
  constexpr int kAround = 96;
  TriMesh mesh;
  for (const double z : {0.0, 0.06}) {
    for (int i = 0; i < kAround; ++i) {
      const double a = 2 * std::numbers::pi * i / kAround;
      mesh.vertices.emplace_back(0.03 * std::cos(a), 0.03 * std::sin(a), z);
    }
  }
  mesh.vertices.emplace_back(0, 0, 0);
  for (int i = 0; i < kAround; ++i) {
    const int j = (i + 1) % kAround;
    mesh.triangles.push_back({i, j, kAround + j});
    mesh.triangles.push_back({i, kAround + j, kAround + i});
    mesh.triangles.push_back({2 * kAround, j, i});
  }
  return mesh;
}

// Oracle: the springs in series, from a surface half a thickness above and below the triangles.
TEST(ThinShell, APlateHoldsABlockFromBothSides) {
  const test::MeshFile file(plate(), "plate");
  for (const double side : {1.0, -1.0}) {
    OneTool tool(toolWorld(kBlock, file.body("plate", "smooth"), kShell));
    const auto hand = [&](double x, double depth) {
      return Pose{{x, 0.003, side * (0.01 + kThick / 2 - depth)}, Quat::Identity()};
    };
    tool.tick(hand(-0.02, -0.005));
    Vec3 last = tool.rest(hand(-0.02, 0.002), 50).f_H_W;
    for (int i = 1; i <= 2000; ++i) {
      const Vec3 now = tool.tick(hand(-0.02 + 2e-5 * i, 0.002)).f_H_W;
      ASSERT_NEAR(now.z(), side * 0.002 * kSeries, 0.01 * 0.002 * kSeries) << i;
      ASSERT_LT((now - last).norm(), 0.01 * now.norm()) << "no jump at the borders of voxels and triangles";
      last = now;
    }
    tool.rest(hand(0.02, 0.03), 200);
    EXPECT_GT(side * tool.state().X_WT.p.z(), 0.01) << "does not go through";
  }
}

TEST(ThinShell, AMugHoldsABallInsideAndABlockOnItsRim) {
  const test::MeshFile file(mug(), "mug");
  const char* const ball = R"(<tool turn_stiffness="2"><sphere radius="0.008"/></tool>)";
  OneTool inside(toolWorld(ball, file.body("mug", "smooth"), kShell));
  inside.tick({{0, 0, 0.08}, Quat::Identity()});
  for (int i = 0; i <= 600; ++i) inside.tick({{0, 0, 0.08 - 1e-4 * i}, Quat::Identity()});
  // pressed against the wall, whose inner side is 29 mm from the axis, less 0.02 mm in the middle of a facet
  const FingerContact& wall = inside.rest({{0.03 - kThick / 2 - 0.008 + 0.002, 0, 0.02}, Quat::Identity()}, 300);
  EXPECT_NEAR(wall.f_H_W.x(), -0.002 * kSeries, 0.05 * 0.002 * kSeries);
  // at the wall the ball rests on the bottom, too; in the middle on the bottom alone
  const FingerContact& bottom = inside.rest({{0, 0, kThick / 2 + 0.008 - 0.002}, Quat::Identity()}, 300);
  EXPECT_NEAR(bottom.f_H_W.z(), 0.002 * kSeries, 0.05 * 0.002 * kSeries);

  OneTool above(
      toolWorld(R"(<tool turn_stiffness="2"><box size="0.08 0.08 0.02"/></tool>)", file.body("mug", "smooth"), kShell));
  above.tick({{0, 0, 0.08}, Quat::Identity()});
  const FingerContact& rim = above.rest({{0, 0, 0.06 + kThick / 2 + 0.01 - 0.002}, Quat::Identity()}, 300);
  EXPECT_NEAR(rim.f_H_W.z(), 0.002 * kSeries, 0.05 * 0.002 * kSeries) << "round, half a thickness above the triangles";
}

std::string refusal(const test::MeshFile& file, const std::string& settings) {
  try {
    OneTool tool(toolWorld(kBlock, file.body("plate", "smooth"), settings));
  } catch (const InputError& error) {
    return error.diagnostics().text();
  }
  return "";
}

TEST(ThinShell, IsRefusedWithoutAThicknessOrWithVoxelsThatMissIt) {
  const test::MeshFile file(plate(), "plate");
  const std::string none = refusal(file, "");
  EXPECT_NE(none.find("E596"), std::string::npos) << none;
  EXPECT_NE(none.find("shell_thickness"), std::string::npos) << none;
  const std::string coarse = refusal(file, R"(<pointshell shell_thickness="0.002" voxel="0.001"/>)");
  EXPECT_NE(coarse.find("E596"), std::string::npos) << coarse;
  EXPECT_NE(coarse.find("2.000000 mm is less than four voxels of 1.000000 mm"), std::string::npos) << coarse;
  EXPECT_EQ(refusal(file, R"(<pointshell shell_thickness="0.002" voxel="0.0005"/>)"), "");
}

}  // namespace
}  // namespace presa::thin_shell_test
