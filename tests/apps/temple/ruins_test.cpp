#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "apps/common/atomic_file.h"
#include "apps/temple/ruins.h"
#include "apps/temple/ruins_cache.h"
#include "apps/temple/spots.h"
#include "framework/scene/load.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

using test::shippedBuilding;

constexpr auto kGoOn = [](std::size_t, std::size_t, const std::string&) { return true; };

Ruins ruinsOf(const Building& building, std::uint64_t seed) {
  return strewRuins(building, seed, test::scratch("ruins"), kGoOn);
}

/// Every block is at rest, on the field, on the ground and inside no other block.
void expectGoodRuins(const Building& building, const Ruins& ruins) {
  // penetration of nearly rigid contacts in a heap
  constexpr double kContact = 2e-4;  // [m]
  ASSERT_EQ(ruins.X_WB.size(), building.blocks.size());
  EXPECT_LT(ruins.still, 2e-4);  // invisible, and below the dynamics' sleeping threshold
  const Field field = fieldFor(building);
  for (std::size_t i = 0; i < building.blocks.size(); ++i) {
    const Block& block = building.blocks[i];
    EXPECT_TRUE(field.holds(ruins.X_WB[i].p)) << block.name;
    for (const Vec3& corner : cornersOf(block, ruins.X_WB[i])) {
      // corners of a cylinder stand for a prism around it
      const double beyond = std::holds_alternative<Cylinder>(block.physics) ? 5e-4 : 0;
      EXPECT_GT(corner.z(), -kContact - beyond) << block.name;
    }
    for (std::size_t j = i + 1; j < building.blocks.size(); ++j) {
      const Block& other = building.blocks[j];
      if ((ruins.X_WB[i].p - ruins.X_WB[j].p).norm() > radiusOf(block.visual) + radiusOf(other.visual)) continue;
      EXPECT_LT(test::overlap(block, ruins.X_WB[i], other, ruins.X_WB[j]), kContact)
          << block.name << ", " << other.name;
    }
  }
}

/// The first start reads these ruins instead of strewing them: to the bit what a drop gives today.
void expectShipped(const Building& building, const Ruins& ruins) {
  const std::string file = "ruins_" + building.name + ".json";
  const std::string fresh = test::scratch("fresh") + "-" + file;
  writeFileAtomically(fresh, ruinsText(building, 1, ruins.X_WB));
  const auto shipped = shippedRuins(building.name, 1);
  ASSERT_TRUE(shipped);
  EXPECT_EQ(ruinsText(building, 1, *shipped), ruinsText(building, 1, ruins.X_WB))
      << "the drop has changed. Once it is as wanted: cp " << fresh << " config/temple/" << file;
}

TEST(Ruins, OfAColumnLieStillForEverySeed) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const Building column = shippedBuilding("column", seed);
    const Ruins ruins = ruinsOf(column, seed);
    expectGoodRuins(column, ruins);
    if (seed == 1) expectShipped(column, ruins);
  }
}

// The shipped ruins are those of the plan they were made of.
TEST(Ruins, OfAnotherPlanAreItsOwn) {
  const std::string folder = test::scratch("other_plan");
  const std::string command = PRESA_BINARY_DIR "/bin/presa temple --size column --plan parthenon --overwrite --write ";
  ASSERT_EQ(std::system((command + folder + " >" + folder + ".txt 2>&1").c_str()), 0);
  const Building column = shippedBuilding("parthenon_column", 1);
  const Ruins ruins = ruinsOf(column, 1);
  Diagnostics diagnostics;
  const Scene written = loadScene(folder + "/scene.xml", {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  for (std::size_t i = 0; i < column.blocks.size(); ++i) {
    EXPECT_EQ(written.bodies[i].name, column.blocks[i].name);
    EXPECT_LT((written.bodies[i].X_WB.p - ruins.X_WB[i].p).norm(), 1e-12) << column.blocks[i].name;
  }
}

/// Distance of the blocks' axes that leaves room for two open fingertips around one of them: half of the pointer's span
/// of 120 mm, a fingertip 16 mm thick, and half of the widest block.
TEST(Ruins, OfTheFirstTaskStandApartAndUpright) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Building first = shippedBuilding("first", seed);
    const Ruins ruins = ruinsOf(first, seed);
    ASSERT_EQ(ruins.X_WB.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      double low = 1e300;
      for (const Vec3& vertex : first.blocks[i].haptic.vertices) low = std::min(low, (ruins.X_WB[i] * vertex).z());
      EXPECT_NEAR(low, 0, 1e-12) << "it stands on the ground";
      EXPECT_NEAR((ruins.X_WB[i].q * Vec3::UnitZ()).z(), 1, 1e-12);
      for (std::size_t j = i + 1; j < 3; ++j)
        EXPECT_GT((ruins.X_WB[i].p - ruins.X_WB[j].p).head<2>().norm(), 0.06 + 0.016 + 0.026);
    }
  }
}

TEST(Ruins, OfAFacadeLieStill) {
  const Building facade = shippedBuilding("facade", 1);
  const Ruins ruins = ruinsOf(facade, 1);
  expectGoodRuins(facade, ruins);
  expectShipped(facade, ruins);
}

TEST(Ruins, AreTheSameForTheSameSeedOnly) {
  const Building column = shippedBuilding("column");
  const Ruins one = ruinsOf(column, 3), same = ruinsOf(column, 3), other = ruinsOf(column, 4);
  double apart = 0;
  for (std::size_t i = 0; i < column.blocks.size(); ++i) {
    EXPECT_EQ(one.X_WB[i].p, same.X_WB[i].p);
    EXPECT_EQ(one.X_WB[i].q.coeffs(), same.X_WB[i].q.coeffs());
    apart = std::max(apart, (one.X_WB[i].p - other.X_WB[i].p).norm());
  }
  EXPECT_GT(apart, 0.02);
}

TEST(Ruins, StopWhenAskedTo) {
  const Building column = shippedBuilding("column");
  const auto stop = [](std::size_t, std::size_t, const std::string&) { return false; };
  EXPECT_TRUE(strewRuins(column, 1, test::scratch("stopped"), stop).X_WB.empty());
}

// The next start reads what this one strewed, to the bit; a damaged file or one of another building is none.
TEST(RuinsCache, KeepsPosesToTheBit) {
  const Building building = shippedBuilding("first");
  const Ruins ruins = ruinsOf(building, 3);
  const std::string file = test::scratch("ruins_cache") + "/below/a.json";
  EXPECT_FALSE(readRuins(file, building));
  keepRuins(file, building, 3, ruins.X_WB);
  const auto kept = readRuins(file, building);
  ASSERT_TRUE(kept);
  ASSERT_EQ(kept->size(), ruins.X_WB.size());
  for (std::size_t i = 0; i < kept->size(); ++i) {
    EXPECT_EQ((*kept)[i].p, ruins.X_WB[i].p);
    EXPECT_EQ((*kept)[i].q.coeffs(), ruins.X_WB[i].q.coeffs());
  }
  EXPECT_FALSE(readRuins(file, shippedBuilding("column")));
  std::filesystem::resize_file(file, 100);
  EXPECT_FALSE(readRuins(file, building));
  keepRuins("/proc/no/such/place.json", building, 3, ruins.X_WB);  // no cache, and no fault
}

TEST(RuinsCache, ShipsTheFirstSeedOnly) {
  EXPECT_FALSE(shippedRuins("facade", 2));
  EXPECT_FALSE(shippedRuins("first", 1));  // stands at once
  EXPECT_FALSE(shippedRuins("parthenon_column", 1));
  EXPECT_FALSE(shippedRuins("", 1));
}

TEST(RuinsCache, HasAFileForEachBuildingAndSeed) {
  const std::string one = ruinsCacheFile(shippedBuilding("first"), 1);
  if (one.empty())
    GTEST_SKIP() << "this build keeps no ruins: no cache folder, or sources that differ from their commit";
  EXPECT_EQ(ruinsCacheFile(shippedBuilding("first"), 1), one);
  EXPECT_NE(ruinsCacheFile(shippedBuilding("first"), 2), one);
  EXPECT_NE(ruinsCacheFile(shippedBuilding("column"), 1), one);
}

}  // namespace
}  // namespace presa::temple
