#include "apps/temple/building/assembly_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "framework/scene/load.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

std::vector<std::string> names(const Building& building, const std::vector<std::size_t>& blocks) {
  std::vector<std::string> all;
  for (const std::size_t i : blocks) all.push_back(building.blocks[i].name);
  return all;
}

std::size_t indexOf(const Building& building, const std::string& name) {
  for (std::size_t i = 0; i < building.blocks.size(); ++i) {
    if (building.blocks[i].name == name) return i;
  }
  throw std::out_of_range(name);
}

TEST(AssemblyText, AColumnIsBuiltDrumByDrum) {
  const Building column = test::shippedBuilding("column");
  EXPECT_THAT(supporting(column, 0), IsEmpty());
  for (std::size_t i = 1; i < column.blocks.size(); ++i) EXPECT_THAT(supporting(column, i), ElementsAre(i - 1));
  for (std::size_t i = 0; i < column.blocks.size(); ++i)
    EXPECT_THAT(fitting(column, i), ElementsAre(i)) << "it tapers: no two drums are alike";
}

TEST(AssemblyText, AFacadeHasAlikesAndLoads) {
  const Building facade = test::shippedBuilding("facade");
  EXPECT_THAT(names(facade, fitting(facade, indexOf(facade, "column2_drum1"))),
              UnorderedElementsAre("column1_drum1", "column2_drum1", "column3_drum1", "column4_drum1"));
  EXPECT_THAT(names(facade, supporting(facade, indexOf(facade, "architrave2"))),
              UnorderedElementsAre("column2_capital", "column3_capital"));
  EXPECT_THAT(names(facade, fitting(facade, indexOf(facade, "tympanum_left"))), ElementsAre("tympanum_left"))
      << "the other is its mirror image";
  for (std::size_t i = 0; i < facade.blocks.size(); ++i) {
    const bool on_the_steps = facade.blocks[i].name.ends_with("drum1");
    EXPECT_EQ(supporting(facade, i).empty(), on_the_steps) << facade.blocks[i].name;
  }
}

/// Blocks that a block overlaps by more than 0.5 mm when it is pushed by 1 mm into its support, normal to its bearing
/// face.
std::set<std::size_t> pushedInto(const Building& building, std::size_t i) {
  Pose pushed = building.blocks[i].X_WB;
  pushed.p -= 1e-3 * (pushed.q * Vec3::UnitZ());
  std::set<std::size_t> under;
  for (std::size_t j = 0; j < building.blocks.size(); ++j) {
    if (j != i && test::overlap(building.blocks[i], pushed, building.blocks[j], building.blocks[j].X_WB) > 0.5e-3)
      under.insert(j);
  }
  return under;
}

// A block is placed after all blocks that support it. Oracle: overlap of the shapes, because a roof's lower tiles are
// lower than the centre of their support. Further predecessors are harmless if they support the supports.
TEST(AssemblyText, ABlockWaitsForAllThatCarriesIt) {
  const Building facade = test::shippedBuilding("facade");
  std::vector<std::set<std::size_t>> carriers;
  for (std::size_t i = 0; i < facade.blocks.size(); ++i) carriers.push_back(pushedInto(facade, i));
  std::vector<std::set<std::size_t>> below = carriers;
  for (std::size_t round = 0; round < facade.blocks.size(); ++round) {
    for (std::set<std::size_t>& under : below) {
      const std::set<std::size_t> known = under;
      for (const std::size_t j : known) under.insert(below[j].begin(), below[j].end());
    }
  }
  for (std::size_t i = 0; i < facade.blocks.size(); ++i) {
    const std::vector<std::size_t> waits = supporting(facade, i);
    EXPECT_THAT(waits, IsSupersetOf(carriers[i])) << facade.blocks[i].name;
    EXPECT_THAT(below[i], IsSupersetOf(waits)) << facade.blocks[i].name;
  }
}

// The scene reader accepts the assembly: every block has a goal, and the order has no cycles.
TEST(AssemblyText, IsAnAssemblyThatSceneFilesTake) {
  for (const char* name : {"column", "facade"}) {
    const Building building = test::shippedBuilding(name);
    SceneSpec spec = assembled(building);
    spec.to_be_built = true;
    Diagnostics diagnostics;
    const Scene scene = parseScene(sceneText(building, spec), "scene.xml", ".", {}, diagnostics);
    ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
    ASSERT_TRUE(scene.assembly);
    ASSERT_EQ(scene.assembly->goals.size(), building.blocks.size());
    for (std::size_t i = 0; i < building.blocks.size(); ++i) {
      EXPECT_EQ(scene.assembly->goals[i].X_WB.p, building.blocks[i].X_WB.p);
      EXPECT_EQ(scene.assembly->goals[i].fold, static_cast<std::size_t>(building.blocks[i].fold));
    }
  }
}

}  // namespace
}  // namespace presa::temple
