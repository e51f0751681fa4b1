// The whole demo without a person: ruins, fingers, friction, places.
#include "apps/presa/temple/visit.h"

#include <gtest/gtest.h>

#include <numbers>

#include "apps/presa/temple/ruins.h"
#include "apps/presa/temple/written_scene.h"
#include "tests/temple/support.h"

namespace presa::temple {
namespace {

/// The column's ruins of that seed, with two fingers that rebuild it.
Rebuilt rebuildColumn(std::uint64_t seed, double limit) {
  const Building column = test::shippedBuilding("column", seed);
  const std::string folder = test::scratch("rebuild" + std::to_string(seed));
  SceneSpec spec = assembled(column);
  const Ruins ruins =
      strewRuins(column, seed, folder, [](std::size_t, std::size_t, const std::string&) { return true; });
  for (SceneSpec::Stone& stone : spec.stones) stone.X_WB = ruins.X_WB[stone.block];
  spec.to_be_built = true;
  spec.rig = PRESA_SOURCE_DIR "/config/rigs/assembling_pair.xml";
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = limit;
  const Loaded loaded = loadWorld({writeScene(column, spec, folder), "", {}}, options, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return visit(loaded, {.finish = 2, .quiet = true}).rebuilt;
}

// Seed 8 has drums and the capital on their heads.
class Rebuild : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Rebuild, AColumnStandsAgain) {
  const Rebuilt rebuilt = rebuildColumn(GetParam(), 600);
  EXPECT_EQ(rebuilt.pieces, 6);
  EXPECT_EQ(rebuilt.placed, 6);
  EXPECT_LT(rebuilt.worst_position_error, 1e-3);
  EXPECT_LT(rebuilt.worst_angle_error, std::numbers::pi / 180);
  EXPECT_EQ(rebuilt.faults, 0U);
  EXPECT_LT(rebuilt.simulated_seconds, 300) << "it ends when all stands";
}

INSTANTIATE_TEST_SUITE_P(Seeds, Rebuild, testing::Values(1, 8));

TEST(RebuildGivenUp, SaysWhatItDidNotGetDone) {
  const Rebuilt rebuilt = rebuildColumn(1, 5);
  EXPECT_LT(rebuilt.placed, 6);
  EXPECT_NEAR(rebuilt.simulated_seconds, 5, 0.01);
  EXPECT_NE(summaryText(rebuilt, "column", 1).find("\"pieces\": 6"), std::string::npos);
}

}  // namespace
}  // namespace presa::temple
