// The device in the whole program: lockstep, shipped scene and rig.
#include <gtest/gtest.h>

#include "apps/common/grasp_figures.h"
#include "devices/admittance/drive.h"
#include "tests/support/shipped_rig.h"

namespace presa {
namespace {

const std::string kScene = PRESA_SOURCE_DIR "/config/scenes/cube.xml";
const std::string kRig = PRESA_SOURCE_DIR "/config/rigs/pinch_cube_admittance.xml";

std::unique_ptr<TerminalRun> lift() { return test::runToTheEnd(kScene, kRig); }

// Expected: a grip of 6 N, since the force loop controls the felt force; the weight shared equally by two fingers; slip
// at m g / (2 mu) = 1.226 N while the grip loosens by 3 N/s. The second finger to slip does so at a lower grip.
TEST(AdmittanceDevice, TwoOfThemLiftTheCube) {
  const auto run = lift();
  const auto grasp = graspFigures(run->result());
  ASSERT_TRUE(grasp);
  EXPECT_NEAR(grasp->lift_height, 0.10, 0.001);
  EXPECT_NEAR(grasp->held_in_stick, 4.0, 0.002);
  ASSERT_EQ(grasp->fingers.size(), 2u);
  std::optional<SlipOnset> first;
  for (const FingerGrasp& finger : grasp->fingers) {
    EXPECT_NEAR(finger.mean_normal_force, 6, 0.1);
    EXPECT_NEAR(finger.weight_share, 1, 0.1);
    ASSERT_TRUE(finger.slip);
    if (!first || finger.slip->time < first->time) first = finger.slip;
  }
  EXPECT_NEAR(first->normal_force, 0.2 * 9.81 / (2 * 0.8), 0.06);
  const ObjectSummary& cube = run->result().objects.at(0).summary;
  EXPECT_FALSE(cube.dropped);
  EXPECT_GT(cube.lost_at, 7.0);
  EXPECT_TRUE(run->result().faults.empty());
}

TEST(AdmittanceDevice, TheSameInputGivesTheSameBits) {
  EXPECT_EQ(lift()->result().state_hash, lift()->result().state_hash);
}

std::unique_ptr<Device> thumb(
    Diagnostics& diagnostics, const std::function<void(DeviceBinding&)>& change = [](DeviceBinding&) {}) {
  return test::firstDevice(kScene, kRig, diagnostics, change);
}

TEST(AdmittanceDevice, ItsTickNeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Diagnostics diagnostics;
  const auto device = thumb(diagnostics);
  ASSERT_TRUE(device) << diagnostics.text();
  test::expectRealTime(*device);
}

// damping() is that of an impedance device with the same max wall stiffness, K = 2 b / T.
TEST(AdmittanceDevice, ClaimsTheDampingOfItsStiffestWall) {
  Diagnostics diagnostics;
  const auto device = thumb(diagnostics, [](DeviceBinding& b) { b.settings["damping"] = {"40", {}}; });
  ASSERT_TRUE(device) << diagnostics.text();
  admittance::Parameters p;
  p.inertia = 1;
  EXPECT_DOUBLE_EQ(2 * device->damping() / 1e-3,
                   admittance::stiffestWall(p, {.mass = 0.1, .stiffness = 300, .damping = 40}, 1e-3));
}

TEST(AdmittanceDevice, NamesEverySettingThatIsWrong) {
  Diagnostics diagnostics;
  EXPECT_EQ(thumb(diagnostics,
                  [](DeviceBinding& b) {
                    b.settings["inertia"] = {"0", {}};
                    b.settings["noise"] = {"-1", {}};
                    b.settings["centre"] = {"0 0", {}};
                    b.settings["half_travel"] = {"0.2 0.2 0", {}};
                  }),
            nullptr);
  EXPECT_EQ(diagnostics.errorCount(), 4u) << diagnostics.text();
  Diagnostics reach;
  EXPECT_EQ(thumb(reach, [](DeviceBinding& b) { b.settings["centre"] = {"0 0.5 0", {}}; }), nullptr);
  EXPECT_EQ(reach.all().at(0).code, 453) << reach.text();
  Diagnostics shaking;
  EXPECT_EQ(thumb(shaking,
                  [](DeviceBinding& b) {
                    b.settings["inertia"] = {"0.001", {}};
                    b.settings["mass"] = {"1", {}};
                    b.settings["bandwidth"] = {"1000", {}};
                  }),
            nullptr);
  EXPECT_EQ(shaking.all().at(0).code, 452) << shaking.text();
}

}  // namespace
}  // namespace presa
