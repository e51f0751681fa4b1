#include <gtest/gtest.h>

#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/body_effect_field.h"

namespace presa {
namespace {

constexpr double kMass = 0.2, kGravity = 9.81;  // of the field's cube

TEST(GravityCompensation, CarriesItsShareOfTheWeight) {
  test::BodyEffectField all("<gravity_compensation max_force=\"10\"/>"),
      part("<gravity_compensation share=\"0.25\" max_force=\"10\"/>");
  EXPECT_TRUE(all.at({}).f_W.isApprox(Vec3(0, 0, kMass * kGravity)));
  EXPECT_TRUE(
      part.at({.v_WCm = Vec3(3, 0, 0), .w_WB = Vec3(0, 9, 0)}).f_W.isApprox(Vec3(0, 0, 0.25 * kMass * kGravity)));
  EXPECT_EQ(part.at({}).torque_W, Vec3::Zero());
  test::BodyEffectField weak("<gravity_compensation max_force=\"0.5\"/>");
  EXPECT_TRUE(weak.at({}).f_W.isApprox(Vec3(0, 0, 0.5)));
  EXPECT_FALSE(weak.broken());
}

TEST(GravityCompensation, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  test::BodyEffectField field("<gravity_compensation max_force=\"10\"/>");
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) field.at({});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

// 2 kg of which a tenth is left: in the hold the fingers carry m g / 10, and when they loosen they slip where friction no
// longer carries it, m g / 10 / (2 mu). The grip falls by some 2 mN in a haptic tick; a slip is seen within a step of the
// dynamics, five ticks.
TEST(GravityCompensation, TheHandCarriesWhatIsLeft) {
  RunOptions options;
  options.duration = 10;
  const auto run = test::runScene("config/scenes/counterweight.xml", {}, options);
  const double left = 2 * kGravity / 10;
  for (const RunResult::ContactPoint& finger : run->result().contact_points) {
    ASSERT_FALSE(finger.slips.empty());
    EXPECT_NEAR(finger.slips.back().normal_force, left / (2 * 0.8), 0.02) << finger.name;
  }
}

}  // namespace
}  // namespace presa
