// Action and reaction in shipped scenes: what the fingers feel is what the bodies get.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "experiments/study/study_run.h"

namespace presa {
namespace {

const std::string kSource = PRESA_SOURCE_DIR;

// Within 1 % over any 0.1 s, for each finger and body that touch all that time; bound of the issue that brought contact
// sets. Velocity alone, without acceleration, gave 5 % (grasp_shaken), 7 % (endurance) and 3 % (block_tower).
constexpr double kBound = 0.01;

/// Runs the scene as it is shipped; returns how many windows of 0.1 s were compared.
std::uint64_t expectWithinBound(const std::string& scene) {
  StudyRun run({.scene = scene});
  run.run();
  std::uint64_t windows = 0;
  for (const FingerSummary& finger : run.monitor().fingers()) {
    windows += finger.reaction.windows;
    EXPECT_LT(finger.reaction.worst, kBound) << scene << " at " << finger.reaction.time << " s";
  }
  return windows;
}

class Impulse : public testing::TestWithParam<const char*> {};

TEST_P(Impulse, RenderedIsGiven) { EXPECT_GT(expectWithinBound(kSource + "/experiments/" + GetParam()), 300U); }
INSTANTIATE_TEST_SUITE_P(Of, Impulse,
                         testing::Values("slip_reaction/scene.xml", "stability/scenes/block_tower.xml",
                                         "stability/scenes/endurance.xml", "stability/scenes/five_fingers.xml",
                                         "stability/scenes/grasp_any_size.xml", "stability/scenes/grasp_in_air.xml",
                                         "stability/scenes/grasp_on_table.xml", "stability/scenes/grasp_shaken.xml",
                                         "stability/scenes/hand_over.xml", "stability/scenes/peg_pushed.xml",
                                         "stability/scenes/pressed_in_corner.xml",
                                         "stability/scenes/pressed_on_table.xml",
                                         "stability/scenes/random_grasping.xml",
                                         "stability/scenes/stall_while_holding.xml", "stability/scenes/tea_tray.xml",
                                         "stability/scenes/three_fingers.xml", "stability/scenes/two_hands.xml"),
                         [](const auto& param) {
                           std::string name = param.param;
                           for (const char* part : {".xml", "stability/scenes/"})
                             if (const std::size_t at = name.find(part); at != std::string::npos)
                               name.erase(at, std::string(part).size());
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

/// The system as printed exchanges forces explicitly, held for a step; printed_test has its figures.
bool isAsPrinted(const std::filesystem::path& scene) {
  return std::filesystem::exists(scene.parent_path() / "printed" / scene.filename());
}

// Nobody has to remember a new scene here.
TEST(Impulse, RenderedIsGivenInEverySceneThatPeopleStart) {
  std::size_t compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSource + "/config/scenes"))
    if (entry.path().extension() == ".xml" && !isAsPrinted(entry.path()) && expectWithinBound(entry.path()) > 0)
      ++compared;
  EXPECT_GE(compared, 6U);
}

// Where the haptic thread moves what fingers hold, a body gets exactly what they feel, whatever changes the force: only
// rounding is left, of sums of some thousand forces.
constexpr double kRounding = 1e-10;

void expectExact(const StudySpec& spec, const std::string& what) {
  StudyRun run(spec);
  run.run();
  std::uint64_t windows = 0;
  for (const FingerSummary& finger : run.monitor().fingers()) {
    windows += finger.reaction.windows;
    EXPECT_LT(finger.reaction.worst, kRounding) << what << " at " << finger.reaction.time << " s";
  }
  EXPECT_GT(windows, 100U) << what;
}

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// A simulated subject who grips at a force of its own, measured by encoders of 58 um, quick as a machine (L0) or as a
// hand: 2.6 to 3.7 % at 200 Hz.
TEST(ImpulseAtHapticRate, IsExactWithASubject) {
  const std::string folder = kSource + "/experiments/slip_reaction/";
  for (const char* level : {"L0", "L1", "L2"}) {
    const std::string rig = testing::TempDir() + "/subject_" + level + ".xml";
    std::ofstream(rig) << replaced(textOf(folder + "rig_simulated.xml"), "\"L1\"", '"' + std::string(level) + '"');
    expectExact({.scene = folder + "scene.xml", .rig = rig, .duration = 12}, level);
  }
  const std::string grip_slip = kSource + "/experiments/grip_slip/";
  expectExact({.scene = grip_slip + "scene.xml", .rig = grip_slip + "rig_simulated.xml", .duration = 12}, "grip_slip");
}

// Ridges of 0.3 mm, 2 mm apart, on a block that slides freely: 35 % at 200 Hz, which a scene must ask for.
TEST(ImpulseAtHapticRate, IsExactOnASteepTexture) {
  std::string scene = textOf(kSource + "/config/scenes/texture_sine.xml");
  scene = replaced(scene, "../rigs/", kSource + "/config/rigs/");
  scene = replaced(scene, "amplitude=\"0.0001\"", "amplitude=\"0.0003\"");
  scene = replaced(scene, "<body name=\"block\" fixed=\"true\"",
                   "<body name=\"floor\" fixed=\"true\" pos=\"0 0 -0.02\">"
                   "<physics><box size=\"2 2 0.04\"/></physics></body><body name=\"block\"");
  scene = replaced(scene, "</haptic>", "</haptic><physics mass=\"0.3\"><box size=\"0.12 0.08 0.02\"/></physics>");
  const std::string path = testing::TempDir() + "/free_ridges.xml";
  std::ofstream(path) << scene;
  expectExact({.scene = path}, "ridges");
}

// The shipped cube with one effect or friction law, and no word about the coupling: those that change forces within a
// step of the dynamics have the haptic rate. At 200 Hz the ridges are 31 % off, the vibration 26, the viscous law 6, the
// textures and the materials 2 to 6, layers, magnet, Stribeck's, Dahl's and LuGre's law 1.1 to 1.9.
TEST(Impulse, RenderedIsGivenToTheCubeWithEachEffect) {
  const std::string rubber = "material/rubber/", law = rubber + "friction/", textures = kSource + "/config/textures/";
  const std::vector<std::vector<std::string>> effects{
      {rubber + "texture/shape=sine", rubber + "texture/amplitude=0.0003", rubber + "texture/wavelength=0.002"},
      {rubber + "texture/shape=noise", rubber + "texture/amplitude=0.0001", rubber + "texture/wavelength=0.002"},
      {rubber + "texture_image/file=" + textures + "weave.png", rubber + "texture_image/width=0.006",
       rubber + "texture_image/amplitude=0.0001"},
      {rubber + "material_image/file=" + textures + "pads.png", rubber + "material_image/width=0.04",
       rubber + "material_image/stiffness=0.4"},
      {rubber + "perturbation/shape=noise", rubber + "perturbation/amplitude=0.0001",
       rubber + "perturbation/wavelength=0.002"},
      {rubber + "layers/skin=0.3", rubber + "layers/thickness=0.002"},
      {rubber + "tap/frequency=150", rubber + "tap/decay=0.01", rubber + "tap/gain=20"},
      {rubber + "vibration/frequency=200", rubber + "vibration/amplitude=0.2"},
      {law + "stribeck/speed=0.02"},
      {law + "lugre/stiffness=1000", law + "lugre/speed=0.02"},
      {law + "dahl/stiffness=2000"},
      {law + "viscous/damping=5"},
      {law + "membrane/stiffness=1000"},
      {law + "torsion=0.004"},
      {"body/cube/magnet/max_force=1", "body/cube/magnet/pos=0.035 0 0"},
      {"body/table/fixture/shape=plane", "body/table/fixture/max_force=1"},
      {"force_field/max_force=1", "force_field/viscosity=2"}};
  for (const std::vector<std::string>& sets : effects) {
    StudyRun run({.scene = kSource + "/config/scenes/cube.xml", .sets = sets});
    run.run();
    for (const FingerSummary& finger : run.monitor().fingers()) {
      EXPECT_GT(finger.reaction.windows, 100U) << sets.front();
      EXPECT_LT(finger.reaction.worst, kBound) << sets.front() << " at " << finger.reaction.time << " s";
    }
  }
}

// Without a word about the coupling: a needle that is turned at 30 rad/s between fingers, 4.2 % at 200 Hz, and the cube
// with stiff surfaces, 1.1 to 1.9 %.
TEST(ImpulseAtHapticRate, IsExactOnANeedleThatSpins) {
  expectExact({.scene = kSource + "/experiments/stability/scenes/needle_spun.xml"}, "needle_spun");
}

TEST(ImpulseAtHapticRate, IsExactOnStiffSurfaces) {
  for (const char* stiffness : {"4000", "10000", "30000"})
    expectExact(
        {.scene = kSource + "/config/scenes/cube.xml", .sets = {std::string("material/rubber/stiffness=") + stiffness}},
        stiffness);
}

}  // namespace
}  // namespace presa
