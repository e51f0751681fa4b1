// Torsional friction over a whole run: the disc of config/scenes/friction_torsion.xml turns with what the stylus felt.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/study/study_run.h"

namespace presa::torsion_run {
namespace {

// On ice, the disc's angular momentum is the impulse of the felt torque at any time. Tolerance: the strongest torque over
// two dynamics steps, because the spin is that at the end of a step ahead, and its torque was predicted a step before.
TEST(TorsionRun, TheDiscTurnsWithTheTorqueThatTheStylusFelt) {
  constexpr double kInertia = 0.3 * 0.06 * 0.06 / 2;  // of the disc [kg m^2]
  StudyRun run({.scene = PRESA_SOURCE_DIR "/config/scenes/friction_torsion.xml"});
  double impulse = 0, strongest = 0, fastest = 0, worst = 0;
  bool slipped = false;
  run.observe([&](const HapticSample& now) {
    if (now.objects == nullptr) return;
    const FingerContact& stylus = now.contact.fingers[0];
    const double torque = stylus.t_H_W.z(), spin = now.objects->bodies[1].w_WB.z();
    impulse += 1e-3 * torque;
    strongest = std::max(strongest, std::abs(torque));
    fastest = std::max(fastest, std::abs(spin));
    worst = std::max(worst, std::abs(kInertia * spin + impulse));
    slipped = slipped || stylus.twist_slips;
  });
  run.run();
  EXPECT_TRUE(slipped) << "when the disc is flicked back";
  EXPECT_GT(strongest, 0.005);
  EXPECT_GT(fastest, 1) << "a quarter of a turn in a second";
  EXPECT_LT(worst, 0.010 * strongest) << fastest;
}

}  // namespace
}  // namespace presa::torsion_run
