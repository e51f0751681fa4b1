// Rates that a scene may set: the age limits of data follow them, so that a grasp holds at any rate. Virtual time.
#include <gtest/gtest.h>

#include "experiments/study/study_run.h"
#include "framework/session/load_world.h"

namespace presa {
namespace {

/// Properties of a grasp that must not depend on the rates.
struct Grasp {
  double highest = 0, lost_at = 0, stick = 0, force = 0, speed = 0;
  bool dropped = true;
  std::uint32_t held_status = 0;  ///< of the output stages, from the lift to the end of the hold
};

Grasp graspOf(const std::string& scene, const std::vector<std::string>& sets) {
  StudyRun run({.scene = std::string(PRESA_SOURCE_DIR) + "/config/scenes/" + scene + ".xml", .sets = sets});
  Grasp grasp;
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.time > 2.5 && sample.tick.time < 7) grasp.held_status |= sample.command.status;
  });
  run.run();
  const ObjectSummary& object = run.monitor().objects().at(1);
  const FingerSummary& finger = run.monitor().fingers()[0];
  grasp.highest = object.highest.z() - object.start.z();
  grasp.lost_at = object.lost_at;
  grasp.dropped = object.dropped;
  grasp.speed = object.peak_speed;
  grasp.stick = finger.seconds[1];
  grasp.force = finger.max_normal_force;
  return grasp;
}

void expectTheSame(const Grasp& grasp, const Grasp& usual, const std::string& what) {
  EXPECT_FALSE(grasp.dropped) << what;
  EXPECT_NEAR(grasp.highest, usual.highest, 0.5e-3) << what;  // the tolerance required for haptic rates
  EXPECT_NEAR(grasp.force, usual.force, 0.01 * usual.force) << what;
  EXPECT_NEAR(grasp.stick, usual.stick, 0.1) << what;  // released within a few periods of the slowest group
  EXPECT_NEAR(grasp.lost_at, usual.lost_at, 0.1) << what;
  EXPECT_LT(grasp.speed, 1.2 * usual.speed) << what;  // fell, was not thrown
  EXPECT_EQ(grasp.held_status, 0u) << what << ": the force of a held object is nowhere faded or cut";
}

// Collision rates from 10 Hz to the haptic rate: patches of a running collision group never count as stale.
TEST(Rates, AnyCollisionRateHoldsTheAmphora) {
  const Grasp usual = graspOf("pinch_and_lift", {});
  for (const char* rate : {"10", "20", "40", "50", "200", "500", "1000"}) {
    const std::string set = std::string("rates/collision=") + rate;
    expectTheSame(graspOf("pinch_and_lift", {set}), usual, set);
  }
}

// Dynamics rates from 40 Hz up, with a watchdog of 50 ms.
TEST(Rates, ADynamicsFromFortyHertzOnHoldsWhatItIsGiven) {
  for (const char* scene : {"cube", "pinch_and_lift"}) {
    const Grasp usual = graspOf(scene, {});
    for (const char* rate : {"40", "50", "100", "500"}) {
      std::vector<std::string> sets{std::string("rates/dynamics=") + rate};
      for (const char* role : {"thumb", "index"})
        sets.push_back(std::string("device/") + role + "/limits/watchdog_ms=50");
      expectTheSame(graspOf(scene, sets), usual, std::string(scene) + " " + sets.front());
    }
  }
}

// An explicit watchdog of 20 ms is too short for these rates and rejected, with one finding per device. Without one,
// the watchdog follows the rate.
TEST(Rates, AWatchdogTooShortForTheDynamicsIsRefused) {
  for (const char* rate : {"40", "50"}) {
    Diagnostics findings;
    const std::string cube = std::string(PRESA_SOURCE_DIR) + "/config/scenes/cube.xml", dynamics = "rates/dynamics=";
    loadWorld({cube, "", {dynamics + rate, "device/thumb/limits/watchdog_ms=20", "device/index/limits/watchdog_ms=20"}},
              {}, findings);
    EXPECT_EQ(findings.errorCount(), 2u) << findings.text();
    for (const Diagnostic& finding : findings.all()) EXPECT_EQ(finding.code, 222);
    Diagnostics none;
    loadWorld({cube, "", {dynamics + rate}}, {}, none);
    EXPECT_FALSE(none.hasErrors()) << none.text();
  }
}

}  // namespace
}  // namespace presa
