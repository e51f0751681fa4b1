// A tool and a free body: the paddle pushes a cube, which resists as Coulomb says.
#include <gtest/gtest.h>

#include "tests/support/lockstep_run.h"

namespace presa::pushing_test {
namespace {

// Oracle: mu m g of 0.5 x 0.2 kg to break away, less than 4 % above it for the inertia of a start within some ticks.
TEST(Pushing, ACubeTakesTheForceOfItsFriction) {
  const test::LockstepRun run(PRESA_SOURCE_DIR "/tests/modules/pointshell/scene/push.xml");
  const double breaks_away = 0.5 * 0.2 * 9.81;
  EXPECT_GT(run.maxNormalForce("paddle"), breaks_away);
  EXPECT_LT(run.maxNormalForce("paddle"), 1.04 * breaks_away);
  EXPECT_LT(run.rise("cube"), 1e-4);
  EXPECT_TRUE(run.faults().empty());
}

}  // namespace
}  // namespace presa::pushing_test
