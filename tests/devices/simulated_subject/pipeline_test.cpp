// The same subject in the real pipeline: 1 kHz haptics, 100 Hz collision, 200 Hz dynamics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/study/study_run.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"
#include "tests/devices/simulated_subject/study.h"

namespace presa::subject {
namespace {

StudySpec specOf(const Cube& cube, const std::string& rig, double duration) {
  const auto set = [](const std::string& path, double value) { return path + "=" + std::to_string(value); };
  return {
      .scene = PRESA_SOURCE_DIR "/experiments/grip_slip/scene.xml",
      .rig = PRESA_SOURCE_DIR "/" + rig,
      .sets = {set("body/cube/physics/mass", cube.mass), set("material/rubber/friction/static", cube.mu_s),
               set("material/rubber/friction/dynamic", cube.mu_d), set("material/rubber/stiffness", cube.stiffness)},
      .duration = duration};
}

constexpr const char* kSilent = "tests/devices/simulated_subject/rig_silent.xml";
constexpr const char* kSimulated = "experiments/grip_slip/rig_simulated.xml";
constexpr const char* kWeak = "tests/devices/simulated_subject/rig_weak.xml";

/// Grip at the first slip of a finger during the release, and whether the release was reached.
struct Release {
  double slip_force = NAN;
  bool done = false;
};

Release releaseOf(const Cube& cube) {
  Release release;
  StudyRun run(specOf(cube, kSilent, 150));
  run.observe([&](const HapticSample& sample) {
    const auto phase = static_cast<Phase>(sample.device.fingers[0].phase);
    release.done = phase == Phase::kDone;
    const FingerContact &thumb = sample.contact.fingers[0], &index = sample.contact.fingers[1];
    if (phase != Phase::kRelease || !std::isnan(release.slip_force)) return;
    if (thumb.mode == ContactMode::kSlip || index.mode == ContactMode::kSlip)
      release.slip_force = 0.5 * (thumb.normal_force + index.normal_force);
  });
  run.run();
  return release;
}

// Rates, coupling and solver must not change the one number that mechanics determines: m g / (2 mu_s) within 0.5 %.
TEST(Pipeline, FirstSlipIsAtTheBoundOfStaticFrictionForEveryCube) {
  for (const Cube& cube : studyCubes()) {
    const Release release = releaseOf(cube);
    EXPECT_TRUE(release.done);
    EXPECT_NEAR(release.slip_force / cube.slipForce(), 1, 0.005)
        << "m " << cube.mass << ", mu_s " << cube.mu_s << ", k " << cube.stiffness;
  }
}

// Squeezed between two soft fingertips a cube would turn, one finger up and one down, unless the hand keeps its fingers
// level.
TEST(Pipeline, TheHeaviestSoftCubeDoesNotTurnBetweenTheFingers) {
  StudyRun run(specOf({.mass = 0.4, .mu_s = 0.4, .mu_d = 0.3, .stiffness = 500}, kWeak, 30));
  double max = 0;
  bool held = false;
  run.observe([&](const HapticSample& sample) {
    const auto& fingers = sample.device.fingers;
    held = held || static_cast<Phase>(fingers[0].phase) == Phase::kHold;
    max = std::max(max, std::abs(fingers[0].p_WH.z() - fingers[1].p_WH.z()));
  });
  run.run();
  EXPECT_TRUE(held);
  EXPECT_LT(max, 5e-3);  // tremor and steps are below 1 mm, but a turning cube turns until it is lost
}

// There are one thumb and one index finger; a third role is rejected.
TEST(Pipeline, ADigitIsTakenOnce) {
  Diagnostics diagnostics;
  const char* const scene = R"(<scene version="1.0" name="three"><world gravity="0 0 -9.81"/>
    <materials><material name="r" stiffness="1000"><friction static="0.8" dynamic="0.6"/></material></materials>
    <body name="cube" material="r"><haptic><box size="0.07 0.07 0.07"/></haptic>
      <physics mass="0.2"><box size="0.07 0.07 0.07"/></physics></body>
    <devices><device role="thumb"/><device role="index"/><device role="other"/></devices></scene>)";
  const char* const rig = R"(<rig version="1.0" name="three"><device role="thumb" driver="simulated_subject"/>
    <device role="index" driver="simulated_subject"/>
    <device role="other" driver="simulated_subject"><set key="digit" value="index"/></device></rig>)";
  loadWorldFromText({scene, "three", rig}, {}, diagnostics);
  EXPECT_NE(diagnostics.text().find("E438"), std::string::npos) << diagnostics.text();
}

std::vector<double> courseOf(const Cube& cube) {
  std::vector<double> course;
  StudyRun run(specOf(cube, kSimulated, 5));
  run.observe([&](const HapticSample& sample) { course.push_back(sample.contact.fingers[1].normal_force); });
  run.run();
  return course;
}

// Both digits belong to one subject, and two runs in one process have separate subjects.
TEST(Pipeline, RunsOfOneProcessDoNotMeet) {
  const std::vector<Cube> cubes = studyCubes();
  const std::vector<double> alone = courseOf(cubes[4]);
  StudyRun beside(specOf(cubes[20], kSimulated, 5));  // a second run with its own subject
  const std::vector<double> other = courseOf(cubes[20]), again = courseOf(cubes[4]);
  beside.run();
  EXPECT_GT(*std::max_element(alone.begin(), alone.end()), 1) << "it grips";
  EXPECT_NE(other, alone);
  EXPECT_EQ(again, alone);
}

}  // namespace
}  // namespace presa::subject
