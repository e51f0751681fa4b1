#include <gtest/gtest.h>

#include <numbers>

#include "apps/common/atomic_file.h"
#include "apps/temple/drop.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

class Standing : public ::testing::TestWithParam<const char*> {};

// A free-standing building neither is pushed apart nor creeps: 0.5 mm and 0.3 degrees would be visible.
TEST_P(Standing, TheBuildingStandsForTenSeconds) {
  const Building building = test::shippedBuilding(GetParam());
  const std::string folder = test::scratch(std::string("standing_") + GetParam());
  std::filesystem::create_directories(folder + "/meshes");
  for (const SceneFile& file : meshFiles(building, true)) writeFileAtomically(folder + "/" + file.path, file.text);
  const DropResult result = drop(building, assembled(building).stones, 10, folder);
  EXPECT_TRUE(result.sound);
  for (std::size_t i = 0; i < building.blocks.size(); ++i) {
    const Block& block = building.blocks[i];
    EXPECT_LT((result.X_WB[i].p - block.X_WB.p).norm(), 0.5e-3) << block.name;
    EXPECT_LT(result.X_WB[i].q.angularDistance(block.X_WB.q), 0.3 * std::numbers::pi / 180) << block.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Buildings, Standing, ::testing::Values("column", "facade"));

}  // namespace
}  // namespace presa::temple
