#include <gtest/gtest.h>

#include <set>

#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

using test::overlap;
using test::shippedBuilding;

const Block& blockNamed(const Building& building, const std::string& name) {
  for (const Block& block : building.blocks) {
    if (block.name == name) return block;
  }
  throw std::out_of_range(name);
}

class Neighbours : public ::testing::TestWithParam<const char*> {};

TEST_P(Neighbours, DoNotOverlap) {
  const Building building = shippedBuilding(GetParam());
  for (std::size_t i = 0; i < building.blocks.size(); ++i) {
    for (std::size_t j = i + 1; j < building.blocks.size(); ++j) {
      const Block &a = building.blocks[i], &b = building.blocks[j];
      if ((a.X_WB.p - b.X_WB.p).norm() > radiusOf(a.visual) + radiusOf(b.visual) + 0.02) continue;
      EXPECT_LT(overlap(a, a.X_WB, b, b.X_WB), 1e-9) << a.name << " and " << b.name;
    }
  }
}

// Every block rests on an earlier block or on the steps: the building can be built in this order.
TEST_P(Neighbours, TouchWhatTheyStandOn) {
  const Building building = shippedBuilding(GetParam());
  double steps = 0;
  for (const Footing& step : building.footings) steps += step.size.z();
  for (std::size_t i = 0; i < building.blocks.size(); ++i) {
    const Block& block = building.blocks[i];
    double lowest = 1e300;
    for (const Vec3& vertex : block.haptic.vertices) lowest = std::min(lowest, (block.X_WB * vertex).z());
    bool held = std::abs(lowest - steps) < 1e-9;
    for (std::size_t j = 0; j < i && !held; ++j) {
      const Block& below = building.blocks[j];
      held = std::abs(overlap(below, below.X_WB, block, block.X_WB)) < 1e-9;
    }
    EXPECT_TRUE(held) << block.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Buildings, Neighbours,
                         ::testing::Values("first", "column", "facade", "parthenon_column", "parthenon_facade"));

TEST(First, HasThreePieces) {
  const Building first = shippedBuilding("first");
  ASSERT_EQ(first.blocks.size(), 3U);
  EXPECT_EQ(first.blocks.back().kind, BlockKind::kCapital);
  // three steps of a quarter of a module and five modules
  EXPECT_NEAR(first.top, (3 * 0.25 + 5) * 0.024, 1e-9);
  EXPECT_TRUE(first.upright);
}

TEST(Column, HasSixPieces) {
  const Building column = shippedBuilding("column");
  ASSERT_EQ(column.blocks.size(), 6U);
  EXPECT_EQ(column.blocks.back().kind, BlockKind::kCapital);
  // three steps of 0.33 modules and fourteen modules
  EXPECT_NEAR(column.top, (3 * 0.33 + 14) * 0.022, 1e-9);
}

// A Doric column stands on the stylobate, a piece of which goes on for four modules to both sides and behind it,
// without steps there. Before the axis it ends where a front's does.
TEST(Column, StandsOnAStylobateAndNotOnABase) {
  for (const char* name : {"first", "column"}) {
    const Building column = shippedBuilding(name);
    ASSERT_EQ(column.footings.size(), 3U) << name;
    const Footing& top = column.footings.back();
    const double module = name == std::string("first") ? 0.024 : 0.022, axis = column.blocks.front().X_WB.p.y();
    EXPECT_NEAR(top.size.x(), 8 * module, 1e-9) << name;
    EXPECT_NEAR(top.X_WB.p.y() - top.size.y() / 2, axis - 1.15 * module, 1e-9) << name;
    EXPECT_NEAR(top.X_WB.p.y() + top.size.y() / 2, axis + 4 * module, 1e-9) << name;
    for (std::size_t i = 1; i < 3; ++i) {  // equal steps with equal treads, all at the front
      const Footing &below = column.footings[i - 1], &step = column.footings[i];
      EXPECT_NEAR(below.size.x(), step.size.x(), 1e-9) << name;
      EXPECT_NEAR(below.size.y() - step.size.y(), 0.5 * module, 1e-9) << name;
      EXPECT_NEAR(below.size.z(), step.size.z(), 1e-9) << name;
    }
  }
}

// 1.70 m at the building's scale, in modules of fifteen feet of 0.296 m over fourteen; on the ground, beside all steps.
TEST(Figure, IsAPersonAtTheBuildingsScale) {
  for (const auto& [name, module] : {std::pair{"first", 0.024}, {"column", 0.022}, {"facade", 0.018}}) {
    const Building building = shippedBuilding(name);
    ASSERT_TRUE(building.figure) << name;
    double low = 1e300, high = -1e300, right = -1e300;
    for (const Vec3& vertex : building.figure->mesh.vertices) {
      const Vec3 p_W = building.figure->X_WB * vertex;
      low = std::min(low, p_W.z()), high = std::max(high, p_W.z()), right = std::max(right, p_W.x());
    }
    EXPECT_NEAR(low, 0, 1e-9) << name;
    EXPECT_NEAR(high, 1.7 * module / (15 * 0.296 / 14), 1e-4) << name;  // the file has three digits
    const Footing& widest = building.footings.front();
    EXPECT_LT(right, widest.X_WB.p.x() - widest.size.x() / 2) << name;
    EXPECT_GT(massProperties(building.figure->mesh).volume, 0) << name;  // its surface faces outwards
  }
}

// At the ridge, raking cornices and tiles of both slopes end in vertical planes, one joint of 0.2 mm apart, over their
// whole height; chips of up to 1.2 mm may be missing from corners.
TEST(Facade, ClosesItsRidge) {
  const Building facade = shippedBuilding("facade");
  for (const auto& [left, right] :
       {std::pair{"raking_cornice_left", "raking_cornice_right"}, {"tile_left2", "tile_right2"}}) {
    for (const int side : {-1, 1}) {
      const Block& block = blockNamed(facade, side < 0 ? left : right);
      const double half = std::get<Box>(block.physics).size.z() / 2;
      for (const double z : {-half, half}) {
        double nearest = 1e300;
        for (const Vec3& vertex : block.visual.vertices)
          if (std::abs(vertex.z() - z) < 1e-6) nearest = std::min(nearest, side * (block.X_WB * vertex).x());
        EXPECT_NEAR(nearest, 1e-4 / std::cos(std::atan(2 * 0.1111)), 1e-5) << block.name << " at " << z;
      }
    }
  }
}

TEST(Facade, FitsTheReachOfTwoArms) {
  const Building facade = shippedBuilding("facade");
  EXPECT_LT(facade.top, 0.4);
  for (const Block& block : facade.blocks) {
    for (const Vec3& vertex : block.visual.vertices) {
      const Vec3 p_W = block.X_WB * vertex;
      EXPECT_LT(std::abs(p_W.x()), 0.3) << block.name;
      EXPECT_LT(std::abs(p_W.y()), 0.15) << block.name;
    }
  }
}

// The systyle front of four columns: 19.5 modules, a triglyph over each column, one between the outer columns and two
// between the inner ones.
TEST(Facade, IsDividedAsVitruviusSays) {
  const Building facade = shippedBuilding("facade");
  std::map<BlockKind, int> count;
  std::set<std::string> names;
  for (const Block& block : facade.blocks) {
    ++count[block.kind];
    names.insert(block.name);
  }
  EXPECT_EQ(names.size(), facade.blocks.size());
  EXPECT_EQ(facade.blocks.size(), 45U);
  EXPECT_EQ(count[BlockKind::kCapital], 4);
  EXPECT_EQ(count[BlockKind::kTriglyph], 4 + 1 + 2 + 1);
  EXPECT_EQ(count[BlockKind::kMetope], 7);
  const double m = 0.018;
  EXPECT_NEAR(blockNamed(facade, "column2_capital").X_WB.p.x(), -3.75 * m, 1e-12);
  const Block &first = blockNamed(facade, "triglyph1"), &last = blockNamed(facade, "triglyph8");
  const auto half = [](const Block& block) { return std::get<Box>(block.physics).size.x() / 2; };
  EXPECT_NEAR(last.X_WB.p.x() + half(last) - (first.X_WB.p.x() - half(first)), 19.5 * m, 1e-12);
  // metopes are as wide as high, except for the joint
  EXPECT_NEAR(2 * half(blockNamed(facade, "metope1")), 1.5 * m - 0.0002, 1e-12);
  const Block &left = blockNamed(facade, "tympanum_left"), &right = blockNamed(facade, "tympanum_right");
  EXPECT_NEAR(left.X_WB.p.x(), -right.X_WB.p.x(), 1e-12);
}

}  // namespace
}  // namespace presa::temple
