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

INSTANTIATE_TEST_SUITE_P(Buildings, Neighbours, ::testing::Values("first", "column", "facade"));

TEST(First, HasThreePieces) {
  const Building first = shippedBuilding("first");
  ASSERT_EQ(first.blocks.size(), 3U);
  EXPECT_EQ(first.blocks.back().kind, BlockKind::kCapital);
  // one step of 0.33 modules and five modules
  EXPECT_NEAR(first.top, (0.33 + 5) * 0.024, 1e-9);
  EXPECT_TRUE(first.upright);
}

TEST(Column, HasSixPieces) {
  const Building column = shippedBuilding("column");
  ASSERT_EQ(column.blocks.size(), 6U);
  EXPECT_EQ(column.blocks.back().kind, BlockKind::kCapital);
  // three steps of 0.33 modules and fourteen modules
  EXPECT_NEAR(column.top, (3 * 0.33 + 14) * 0.022, 1e-9);
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
