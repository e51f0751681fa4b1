// The whole demonstration without a person: ruins, simulated fingers, friction, goals.
#include "apps/temple/visit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/temple/ruins.h"
#include "apps/temple/written_scene.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

/// The column's ruins with this seed, rebuilt by two simulated fingers.
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
  Loaded loaded = loadWorld({writeScene(column, spec, folder), "", {}}, options, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return visit(std::move(loaded), {.finish = 2, .quiet = true}).rebuilt;
}

// With seed 8 drums and the capital lie upside down.
class Rebuild : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Rebuild, AColumnStandsAgain) {
  const Rebuilt rebuilt = rebuildColumn(GetParam(), 600);
  EXPECT_EQ(rebuilt.pieces, 6);
  EXPECT_EQ(rebuilt.placed, 6);
  EXPECT_LT(rebuilt.worst_position_error, 1e-3);
  EXPECT_LT(rebuilt.worst_angle_error, std::numbers::pi / 180);
  EXPECT_EQ(rebuilt.faults, 0U);
  EXPECT_GT(rebuilt.mean_penetration, 0);
  EXPECT_LT(rebuilt.mean_penetration, 0.2e-3);
  EXPECT_GE(rebuilt.worst_penetration, rebuilt.mean_penetration);
  EXPECT_EQ(rebuilt.lost, 0);
  EXPECT_LT(rebuilt.simulated_seconds, 300) << "it ends when all stands";
}

INSTANTIATE_TEST_SUITE_P(Seeds, Rebuild, testing::Values(1, 8));

TEST(RebuildGivenUp, SaysWhatItDidNotGetDone) {
  const Rebuilt rebuilt = rebuildColumn(1, 5);
  EXPECT_LT(rebuilt.placed, 6);
  EXPECT_NEAR(rebuilt.simulated_seconds, 5, 0.01);
  EXPECT_NE(summaryText(rebuilt, "column", 1).find("\"pieces\": 6"), std::string::npos);
}

/// A block in a workspace 2 m wide and 1 m high, with a state every 5 ms.
struct Watched {
  Watched() {
    auto made = std::make_shared<World>();
    made->scene.bodies.resize(2);
    made->scene.assembly.emplace();
    made->scene.assembly->workspace = Assembly::Workspace{{0, 0, 0.5}, {2, 2, 1}};
    made->scene.assembly->goals.emplace_back().bodies = {1};
    watch = std::make_unique<BlockWatch>(std::move(made));
    state.bodies.resize(2);
  }
  void at(const Vec3& p, int steps, const BodyPenetration& in = {0, 0, 0}) {
    state.bodies[1].X_WB_end.p = p;
    state.penetration = in;
    for (int i = 0; i < steps; ++i) {
      state.time_end = ++count * 5e-3;
      for (int tick = 0; tick < 5; ++tick) watch->see(state);  // the same state five times
    }
  }
  std::unique_ptr<BlockWatch> watch;
  ObjectState state;
  int count = 0;
};

TEST(BlockWatch, CountsWhatIsLostAtTheEndAndHowLongItWasOutside) {
  Watched run;
  run.at({0.5, 0, 0.1}, 100);
  EXPECT_EQ(run.watch->longestOutside(), 0);
  for (const Vec3& p : {Vec3(1.01, 0, 0.1), Vec3(0, 0, -0.01), Vec3(0, 0, 1.01), Vec3(NAN, 0, 0)}) {
    run.at(p, 200);
    EXPECT_EQ(run.watch->lost(), 1) << p.transpose();
    EXPECT_NEAR(run.watch->longestOutside(), 1, 1e-9);
    run.at({0.5, 0, 0.1}, 20);
    EXPECT_EQ(run.watch->lost(), 0);
  }
}

// 20 steps of 3 points 10 um deep, one impact of 1 mm at 9 points, then no contact: a mean of (600 + 9000) / 69 um. In
// a window of 0.1 s, 20 steps, the impact counts a twentieth.
TEST(BlockWatch, ABlowIsNoRestingDepth) {
  Watched run;
  run.at({0, 0, 0}, 20, {3, 10e-6, 20e-6});
  EXPECT_NEAR(run.watch->meanPenetration(), 10e-6, 1e-12);
  EXPECT_NEAR(run.watch->worstPenetration(), 20e-6, 1e-12);
  run.at({0, 0, 0}, 1, {9, 1e-3, 2e-3});
  run.at({0, 0, 0}, 19);
  EXPECT_NEAR(run.watch->meanPenetration(), 9600e-6 / 69, 1e-12);
  EXPECT_NEAR(run.watch->worstPenetration(), 2e-3 / 20, 1e-12);
}

TEST(BlockWatch, WhatTheEngineDoesNotSayIsNotZero) {
  Watched run;
  run.at({0, 0, 0}, 30, {});
  EXPECT_TRUE(std::isnan(run.watch->meanPenetration()));
  EXPECT_TRUE(std::isnan(run.watch->worstPenetration()));
  Rebuilt rebuilt;
  rebuilt.mean_penetration = run.watch->meanPenetration();
  EXPECT_NE(summaryText(rebuilt, "column", 1).find("\"mean_penetration_m\": null"), std::string::npos);
}

}  // namespace
}  // namespace presa::temple
