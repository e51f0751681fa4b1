#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/temple/building/column_blocks.h"
#include "apps/temple/building/entablature_blocks.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

using test::shippedBuilding;
using test::shippedWith;

constexpr double kPi = std::numbers::pi;

RandomStream anyChips() { return {1, "chips"}; }

/// Area of a polygon of `flutes` quarter circles, each of `parts` chords, over the arris radius squared.
double flutedArea(int flutes, int parts) {
  // the regular polygon of the arrises, minus a segment for each flute, of radius sqrt(2) half chords
  const double half = std::sin(kPi / flutes), polygon = 0.5 * flutes * std::sin(2 * kPi / flutes);
  const double sector = 0.5 * parts * 2 * half * half * std::sin(kPi / 2 / parts), triangle = half * half;
  return polygon - flutes * (sector - triangle);
}

void expectSound(const TriMesh& mesh, const std::string& name) {
  const MeshReport report = checkMesh(mesh);
  EXPECT_GT(report.triangles, 10U) << name;
  EXPECT_TRUE(report.closed()) << name;
  EXPECT_EQ(report.non_finite + report.bad_index + report.degenerate + report.flipped_edges, 0U) << name;
  EXPECT_FALSE(report.inverted) << name;
  // one surface, without handles: V - E + F = 2
  EXPECT_EQ(report.vertices + report.triangles - 3 * report.triangles / 2, 2U) << name;
}

class EveryBlock : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryBlock, HasClosedMeshesForEveryDrawOfItsChips) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    for (const Block& block : shippedBuilding(GetParam(), seed).blocks) {
      expectSound(block.visual, block.name + " seen");
      expectSound(block.haptic, block.name + " felt");
      if (!block.physics_mesh.triangles.empty()) expectSound(block.physics_mesh, block.name + " moved");
    }
  }
}

// Visual and haptic mesh lie inside the physics shape: no part of a block appears inside another one. Only the mitred
// ends that close the ridge reach out, by the slope's tangent times the height of raking cornice or tile.
TEST_P(EveryBlock, IsEnclosedByItsPhysicsShape) {
  constexpr double kRounding = 1e-9;
  const Proportions p = shippedWith(GetParam());
  const double slope = p.pediment ? 2 * p.pediment->height : 0;  // it rises to the middle of the cornice
  for (const Block& block : shippedBuilding(GetParam()).blocks) {
    for (const TriMesh* mesh : {&block.visual, &block.haptic}) {
      for (const Vec3& at : mesh->vertices) {
        if (const Box* box = std::get_if<Box>(&block.physics)) {
          const bool sloped = block.kind == BlockKind::kRakingCornice || block.kind == BlockKind::kTile;
          const Vec3 beyond(sloped ? slope * box->size.z() : 0, 0, 0);
          ASSERT_LE((at.cwiseAbs() - box->size / 2 - beyond).maxCoeff(), kRounding) << block.name;
        }
        if (const Cylinder* rod = std::get_if<Cylinder>(&block.physics)) {
          ASSERT_LE(std::max(at.head<2>().norm() - rod->radius, std::abs(at.z()) - rod->length / 2), kRounding)
              << block.name;
        }
      }
    }
  }
}

TEST_P(EveryBlock, IsAsHeavyAsTwoFingersHold) {
  const Proportions p = shippedWith(GetParam());
  for (const Block& block : shippedBuilding(GetParam()).blocks) {
    EXPECT_GE(block.mass, 0.05) << block.name;
    EXPECT_LE(block.mass, 0.3) << block.name;
    const double weighed = p.stone.density * massProperties(block.haptic).volume;
    if (weighed > 0.05 && weighed < 0.3) {
      EXPECT_NEAR(block.mass, weighed, 1e-12) << block.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Buildings, EveryBlock,
                         ::testing::Values("first", "column", "facade", "parthenon_column", "parthenon_facade"));

// A drum without entasis, holes and chips is a frustum over a polygon of quarter circles, of volume h A (1 + k + k^2) /
// 3.
TEST(Drum, HasTheVolumeOfAFlutedFrustum) {
  Proportions p = shippedWith("column");
  p.column.entasis = 0;
  p.stone.chips = 0;
  p.column.dowel_depth = 1e-9;
  const double h = drumHeight(p), r0 = shaftRadius(p, 2 * h), k = shaftRadius(p, 3 * h) / r0;
  EXPECT_NEAR(r0, p.module * (1 - 2.0 / 5 / 6), 1e-5 * p.module);  // from 1 to 5/6 over five drums
  const Block drum = makeDrum(p, 2, anyChips());
  const double frustum = h * r0 * r0 * (1 + k + k * k) / 3;
  EXPECT_NEAR(massProperties(drum.visual).volume, frustum * flutedArea(20, 8), 1e-6 * frustum);
  EXPECT_NEAR(massProperties(drum.haptic).volume, frustum * flutedArea(20, 4), 1e-6 * frustum);
}

TEST(Drum, LosesAHoleOnEitherSide) {
  Proportions p = shippedWith("column");
  p.stone.chips = 0;
  const double with = massProperties(makeDrum(p, 0, anyChips()).haptic).volume;
  const double depth = p.column.dowel_depth * p.module, width = p.column.dowel_width * p.module;
  p.column.dowel_depth = 1e-9;
  const double without = massProperties(makeDrum(p, 0, anyChips()).haptic).volume;
  EXPECT_NEAR(without - with, 2 * depth * width * width, 1e-12);
}

// The centre of the arc is in the middle of a square on the flute's chord: the flute is (sqrt(2) - 1) / 2 of the chord
// deep.
TEST(Drum, HasFlutesOfAQuarterCircle) {
  Proportions p = shippedWith("column");
  p.stone.chips = 0;
  double shallow = 0, deep = 1;
  const Block drum = makeDrum(p, 0, anyChips());
  const double low = -drumHeight(p) / 2, foot = shaftRadius(p, 0);
  for (const Vec3& v : drum.visual.vertices) {
    if (v.z() > low + 1e-9 || v.head<2>().norm() < 0.9 * foot) continue;
    shallow = std::max(shallow, v.head<2>().norm());
    deep = std::min(deep, v.head<2>().norm());
  }
  const double chord = 2 * foot * std::sin(kPi / 20);
  EXPECT_NEAR(shallow, foot, 1e-9);
  EXPECT_NEAR(foot * std::cos(kPi / 20) - deep, (std::sqrt(2.0) - 1) / 2 * chord, 1e-9);
}

TEST(Shaft, SwellsByItsEntasisHalfWayUp) {
  const Proportions p = shippedWith("column");
  const double shaft = 5 * drumHeight(p), straight = (shaftRadius(p, 0) + shaftRadius(p, shaft)) / 2;
  EXPECT_NEAR(shaftRadius(p, shaft / 2) - straight, 0.018 * p.module, 1e-12);
  EXPECT_NEAR(shaftRadius(p, shaft), 5.0 / 6 * p.module, 1e-4 * p.module);
}

TEST(Entablature, BlocksHaveTheVolumesOfTheirProfiles) {
  Proportions p = shippedWith("facade");
  p.stone.chips = 0;
  const double m = p.module, half = 1.6667 / 2 * m;
  // a T of stem and taenia
  EXPECT_NEAR(massProperties(makeArchitrave(p, 0.1, anyChips()).haptic).volume,
              0.1 * 2 * (half * 0.1429 * m + (half - 0.06 * m) * (1 - 0.1429) * m), 1e-9 * 0.1);
  // a prism over a trapezium
  EXPECT_NEAR(massProperties(makeTympanum(p, 0.15, 0.006, 0.04, anyChips()).haptic).volume, 0.15 * 0.023 * 2 * half,
              1e-12);
  // two whole channels and two halves on each face, each as deep as half its width: halves of squares with edge `part`
  const double part = m / 6, channels = 2 * (2 * part * part / 4 + 2 * part * part / 8);
  const double whole = (m - p.stone.joint) * 2 * half * (1.5 + 0.1667) * m;
  const double triglyph = massProperties(makeTriglyph(p, 0, anyChips()).haptic).volume;
  // half a joint cuts into the half channels
  EXPECT_NEAR(whole - triglyph, channels * 1.5 * m, 0.12 * channels * 1.5 * m);
}

TEST(Chips, TakeStoneAwayAndNeverAdd) {
  for (const char* name : {"column", "facade"}) {
    Proportions p = shippedWith(name);
    const Building chipped = makeBuilding(p, 0.1, 1);
    p.stone.chips = 0;
    const Building whole = makeBuilding(p, 0.1, 1);
    for (std::size_t i = 0; i < whole.blocks.size(); ++i) {
      const double lost =
          massProperties(whole.blocks[i].haptic).volume - massProperties(chipped.blocks[i].haptic).volume;
      EXPECT_GT(lost, 0) << whole.blocks[i].name;
      EXPECT_LT(lost, 0.03 * massProperties(whole.blocks[i].haptic).volume) << whole.blocks[i].name;
    }
  }
}

TEST(Chips, AreElsewhereForAnotherSeedOnly) {
  const Building one = shippedBuilding("column", 7), same = shippedBuilding("column", 7),
                 other = shippedBuilding("column", 8);
  for (std::size_t i = 0; i < one.blocks.size(); ++i) {
    EXPECT_EQ(one.blocks[i].visual.vertices, same.blocks[i].visual.vertices);
    EXPECT_NE(one.blocks[i].visual.vertices, other.blocks[i].visual.vertices);
  }
}

}  // namespace
}  // namespace presa::temple
