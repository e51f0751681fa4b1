// The shipped rig whose user walks with the cube in hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "experiments/study/study_run.h"

namespace presa {
namespace {

// At 4.9 s the user stands 0.3 m aside, turned by 40 degrees, and so do the points of the cube between the fingers: the
// axis of the grasp, 5 mm above the cube's centre. About that axis the cube swings, as by a string, by up to a / g = 0.09
// rad; it is put down swinging. Tolerance: proxies creep by 0.1 mm in a hold (CubeGrasp), and two of them are 70 mm apart.
TEST(WalkingPair, CarriesTheCubeAlong) {
  StudyRun run(
      {.scene = PRESA_SOURCE_DIR "/config/scenes/cube.xml", .rig = PRESA_SOURCE_DIR "/config/rigs/walking_pair.xml"});
  constexpr std::size_t kCube = 1;
  Pose there, start;
  bool slipped = false;
  run.observe([&](const HapticSample& sample) {
    if (sample.objects == nullptr) return;
    const Pose X_WB = sample.objects->poseAt(kCube, sample.tick.time);
    if (sample.tick.time < 3.15) start = X_WB;
    if (sample.tick.time < 4.9) there = X_WB;
    if (sample.tick.time < 3.1 || sample.tick.time > 6.5) return;
    for (const FingerContact& finger : sample.contact.fingers) slipped = slipped || finger.mode != ContactMode::kStick;
  });
  run.run();
  const Pose moved{{0.3, 0.1, 0}, Quat(Eigen::AngleAxisd(40 * std::numbers::pi / 180, Vec3::UnitZ()))};
  for (const double side : {-0.035, 0.035}) {
    const Vec3 p_BG(side, 0, 0.005);
    EXPECT_LT((there * p_BG - moved * (start * p_BG)).norm(), 0.2e-3) << side;
  }
  EXPECT_FALSE(slipped);
  EXPECT_LT((run.monitor().objects()[kCube].final - Vec3(0, 0, 0.035)).norm(), 0.02) << "and puts it back";
  for (const FingerSummary& finger : run.monitor().fingers()) EXPECT_LT(finger.reaction.worst, 0.01);
}

}  // namespace
}  // namespace presa
