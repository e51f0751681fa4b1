// Two simulated fingers place the last six, inclined blocks of the façade on the standing part.
#include <gtest/gtest.h>

#include <numbers>

#include "apps/temple/visit.h"
#include "apps/temple/written_scene.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

/// The façade without its roof, whose plates lie on the ground in front of it, one of them upside down.
SceneSpec withoutRoof(const Building& facade) {
  SceneSpec spec = assembled(facade);
  double x = -0.25;
  for (SceneSpec::Stone& stone : spec.stones) {
    const Block& block = facade.blocks[stone.block];
    if (block.kind != BlockKind::kRakingCornice && block.kind != BlockKind::kTile) continue;
    const bool on_its_head = block.name == "raking_cornice_left";
    const double half = std::get<Box>(block.physics).size.z() / 2;
    stone.X_WB = {{x, -0.15, half}, Quat::Identity()};
    if (on_its_head) stone.X_WB.q = Quat(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
    x += 0.12;
    if (block.kind == BlockKind::kRakingCornice) x += 0.12;
  }
  return spec;
}

TEST(Roof, IsPutByTwoFingers) {
  const Building facade = test::shippedBuilding("facade");
  SceneSpec spec = withoutRoof(facade);
  spec.to_be_built = true;
  spec.rig = PRESA_SOURCE_DIR "/config/rigs/assembling_pair.xml";
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 600;
  Loaded loaded = loadWorld({writeScene(facade, spec, test::scratch("roof")), "", {}}, options, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  const Rebuilt rebuilt = visit(std::move(loaded), {.finish = 0.5, .quiet = true}).rebuilt;
  EXPECT_EQ(rebuilt.placed, static_cast<int>(facade.blocks.size()));
  EXPECT_LT(rebuilt.worst_position_error, 1e-3);
  EXPECT_LT(rebuilt.worst_angle_error, std::numbers::pi / 180);
  EXPECT_EQ(rebuilt.faults, 0U);
}

}  // namespace
}  // namespace presa::temple
