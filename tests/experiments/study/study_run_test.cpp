#include "experiments/study/study_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/study/prescribed_finger.h"

namespace presa {
namespace {

const std::string kCube = PRESA_SOURCE_DIR "/config/scenes/cube.xml";

TEST(StudyRun, EndsWithTheScriptAndGivesTheSameBitsTwice) {
  std::uint64_t hashes[2];
  for (std::uint64_t& hash : hashes) {
    StudyRun run({.scene = kCube, .sets = {"body/cube/physics/mass=0.1"}});
    double last = -1;
    std::uint64_t ticks = 0;
    run.observe([&](const HapticSample& sample) {
      last = sample.tick.time;
      ++ticks;
    });
    run.run();
    EXPECT_DOUBLE_EQ(run.duration(), 10);
    EXPECT_EQ(ticks, 10'000u);
    EXPECT_NEAR(last, 9.999, 1e-9);
    hash = run.monitor().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// A finger held 2 mm inside the fixed table feels k times the depth once the soft start is over.
TEST(StudyRun, APrescribedFingerFeelsTheSpringOfTheSurface) {
  DeviceList devices;
  for (const double x : {-0.2, 0.2}) {
    devices.push_back(std::make_unique<PrescribedFinger>([x](double time) {
      const double z = std::max(0.006, 0.05 - 0.1 * time);  // table top at z = 0, fingertip radius 8 mm
      return PrescribedFinger::State{Vec3(x, 0, z), Vec3(0, 0, z > 0.006 ? -0.1 : 0)};
    }));
  }
  StudyRun run({.scene = kCube, .duration = 1}, std::move(devices));
  double force = 0;
  run.observe([&](const HapticSample& sample) { force = sample.command.f_H_W[0].z(); });
  run.run();
  EXPECT_NEAR(force, 2000 * 0.002, 1e-9);
}

// While dynamics is stalled no ObjectState arrives. After 50 ms the missed ticks are caught up; after 500 ms they are
// skipped.
TEST(StudyRun, AStalledGroupCatchesUpAndALongStallIsGivenUp) {
  for (const double stall : {0.05, 0.5}) {
    StudyRun run({.scene = kCube, .duration = 2});
    run.delay([stall](RateGroup group, double time) {
      return group == RateGroup::kDynamics && time >= 1 && time < 1 + stall;
    });
    double oldest = 0, end = 0;
    run.observe([&](const HapticSample& sample) {
      oldest = std::max(oldest, sample.tick.time - sample.objects->time_end);
      end = sample.objects->time_end;
    });
    run.run();
    EXPECT_NEAR(oldest, stall - 0.001, 0.0011);
    EXPECT_NEAR(end, 2.0, 1e-9);
    const GroupTiming& timing = run.timing(RateGroup::kDynamics);
    EXPECT_EQ(timing.skipped.load(), stall < 0.1 ? 0u : 100u);
    EXPECT_EQ(timing.ticks.load() + timing.skipped.load(), 400u);
  }
}

}  // namespace
}  // namespace presa
