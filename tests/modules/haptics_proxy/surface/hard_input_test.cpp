// Meshes that the importer refuses or warns of: on any of them the force on the hand is that of a spring.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/modules/haptics_proxy/surface/support/hard_meshes.h"
#include "tests/modules/haptics_proxy/surface/support/wander_run.h"

namespace presa::test {
namespace {

class HardInput : public testing::TestWithParam<HardMesh> {};

TEST_P(HardInput, GivesAForceThatASpringExplains) {
  const MeshOracle oracle(*GetParam().mesh);
  for (const double radius : {0.0, 0.5e-3, 2e-3, 8e-3}) {
    for (const double friction : {0.0, 0.5}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius * 1e3 << " mm, friction " << friction);
      WanderRun run(GetParam().mesh, oracle, {.radius = radius, .friction = friction}, 3, false, false);
      run.run(700);
      const WanderFaults& faults = run.faults();
      // otherwise the test would be empty
      EXPECT_GT(faults.touching, GetParam().is_wide || radius > 1e-3 ? 20 : -1);
      EXPECT_EQ(faults.not_finite, 0) << "ticks";
      EXPECT_EQ(faults.too_strong, 0) << "ticks";
      EXPECT_EQ(faults.overlapping, 0) << "ticks; by up to " << faults.deepest * 1e6 << " um";
      EXPECT_EQ(faults.popped, 0u);
      EXPECT_EQ(faults.lost, 0u) << "ticks";
      EXPECT_LE(friction == 0 ? faults.worst_growth : 0, 1e-6);  // accuracy of a position
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, HardInput, testing::ValuesIn(hardMeshes()), [](const auto& of) { return of.param.name; });

// A gap narrower than the fingertip holds it: the centre sinks between the edges to exactly sqrt(r^2 - (gap / 2)^2).
TEST(HardInput, ACrackHoldsAFingertipThatIsWider) {
  for (const double gap : {1e-6, 10e-6, 100e-6, 1e-3}) {
    for (const double radius : {0.6e-3, 2e-3, 8e-3}) {
      SCOPED_TRACE(testing::Message() << "gap " << gap * 1e6 << " um, radius " << radius * 1e3 << " mm");
      const auto mesh = std::make_shared<const TriMesh>(strips(gap, 9));
      const MeshOracle oracle(*mesh);
      FingerRig rig(mesh, {.radius = radius});
      const double lowest = std::sqrt(radius * radius - gap * gap / 4);
      double min = 1e300;
      for (int i = 0; i < 40; ++i) rig.tick({-0.03, 0, 0.01 - i * 0.4e-3});
      for (int i = 0; i < 600; ++i) {
        const Vec3 h(-0.03 + i * 0.1e-3, 0.1e-3 * (i % 50), -0.006);
        min = std::min(min, rig.tick(h).p_WP.z());
      }
      EXPECT_GE(min, lowest - 1e-6);  // accuracy of a position
      EXPECT_LE(min, radius + 1e-6);
      EXPECT_EQ(rig.all().pop_through, 0u);
      EXPECT_EQ(rig.all().coverage_lost, 0u);
    }
  }
}

}  // namespace
}  // namespace presa::test
