#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "experiments/study/study_run.h"

namespace presa {
namespace {

const char* const kScene = R"(<scene version="1.0" name="fall"><world gravity="0 0 -9.81"/>
  <materials><material name="wood" stiffness="2000"><friction static="0.5"/></material></materials>
  <body name="floor" fixed="true" pos="0 0 -0.5"><physics><box size="4 4 1"/></physics></body>
  <body name="ball" pos="0 0 1"><physics mass="1"><sphere radius="0.1"/></physics></body>
  <body name="box" pos="1 1 0.1" velocity="1 0 0"><physics mass="1"><box size="0.4 0.4 0.2"/></physics></body>
</scene>)";

class Engines : public testing::TestWithParam<const char*> {};

// The same scene under every engine against closed forms: free fall (symplectic Euler at h: v = g t exactly), rest on
// the floor, and a sliding distance of v^2 / (2 mu g) = 102 mm.
TEST_P(Engines, FallRestAndSlideAsTheTextbookSays) {
  const auto file = std::filesystem::temp_directory_path() / ("presa_engines_" + std::to_string(::getpid()) + ".xml");
  std::ofstream(file) << kScene;
  StudyRun run({.scene = file.string(), .sets = {std::string("dynamics/engine=") + GetParam()}, .duration = 2});
  double fall_speed = 0, height = 0, slide = 0;
  run.observe([&](const HapticSample& sample) {
    if (sample.objects == nullptr) return;
    if (sample.objects->time_end < 0.4 + 1e-9) fall_speed = -sample.objects->bodies[1].v_WB.z();
    height = sample.objects->bodies[1].X_WB_end.p.z();
    slide = sample.objects->bodies[2].X_WB_end.p.x() - 1;
  });
  run.run();
  std::filesystem::remove(file);
  EXPECT_NEAR(fall_speed, 9.81 * 0.4, 1e-9);
  EXPECT_NEAR(height, 0.1, 0.0005) << "soft contacts sink by less than half a millimetre";
  // half a step of travel at the start speed, plus 2 % for MuJoCo's soft friction
  EXPECT_NEAR(slide, 1 / (2 * 0.5 * 9.81), 0.0025 + 0.02 * 0.102);
}

// A bench of two separate feet: it stands at half their height, level. With one foot it would fall over.
TEST_P(Engines, StandOnAllShapesOfABody) {
  const auto file = std::filesystem::temp_directory_path() / ("presa_bench_" + std::to_string(::getpid()) + ".xml");
  std::ofstream(file) << R"(<scene version="1.0" name="bench"><world gravity="0 0 -9.81"/>
  <materials><material name="wood" stiffness="2000"><friction static="0.5"/></material></materials>
  <body name="floor" fixed="true" pos="0 0 -0.5"><physics><box size="4 4 1"/></physics></body>
  <body name="bench" pos="0 0 0.11"><physics mass="1">
    <box size="0.1 0.2 0.2" pos="-0.3 0 0"/><box size="0.1 0.2 0.2" pos="0.3 0 0"/></physics></body>
</scene>)";
  StudyRun run({.scene = file.string(), .sets = {std::string("dynamics/engine=") + GetParam()}, .duration = 2});
  Pose X_WB;
  run.observe([&](const HapticSample& sample) {
    if (sample.objects != nullptr) X_WB = sample.objects->bodies[1].X_WB_end;
  });
  run.run();
  std::filesystem::remove(file);
  EXPECT_NEAR(X_WB.p.z(), 0.1, 0.0005);
  EXPECT_LT(X_WB.q.angularDistance(Quat::Identity()), 0.002);  // the same, over half the bench
}

INSTANTIATE_TEST_SUITE_P(All, Engines, testing::Values("ode", "mujoco", "bullet"),
                         [](const auto& param) { return std::string(param.param); });

TEST(EnginesToCompareWith, KnowNoFingers) {
  EXPECT_THROW(StudyRun({.scene = PRESA_SOURCE_DIR "/config/scenes/cube.xml", .sets = {"dynamics/engine=bullet"}}),
               InputError);
}

}  // namespace
}  // namespace presa
