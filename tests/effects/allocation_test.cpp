#include <gtest/gtest.h>

#include "framework/session/load_world.h"
#include "framework/session/session.h"
#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/guarded_steps.h"

namespace presa {
namespace {

// The whole script of shipped scenes: reach, squeeze, lift, hold, slip and drop; strokes over surfaces with an effect.
TEST(Allocation, NoTickAllocates) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  for (const char* scene :
       {"config/scenes/cube.xml", "config/scenes/pinch_and_lift.xml", "config/scenes/layers.xml",
        "config/scenes/perturbation.xml", "config/scenes/texture_image.xml", "config/scenes/material_image.xml",
        "config/scenes/mesh_material.xml", "config/scenes/peg_in_hole.xml", "config/scenes/thimbles.xml",
        "config/scenes/square_peg.xml", "config/scenes/ray.xml"}) {
    Diagnostics diagnostics;
    Loaded loaded = loadWorld({test::source(scene), "", {}}, {}, diagnostics);
    ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
    RunControl control;
    Session session(std::move(loaded), control, {});
    test::GuardedSteps steps(session);
    steps.run(10'000);
    for (const RateGroup group : {RateGroup::kHaptic, RateGroup::kCollision, RateGroup::kDynamics})
      EXPECT_EQ(steps.violation(group), "") << scene << ' ' << toString(group);
  }
}

}  // namespace
}  // namespace presa
