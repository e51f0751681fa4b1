#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/apps/support/support.h"
#include "tests/effects/instructions.h"

namespace presa {
namespace {

namespace fs = std::filesystem;
using test::countPerTick;
using test::scratch;
using test::source;
using test::TickCount;

// Max cost of a switched-off effect [instructions per tick]. Measured differences are 0; a single branch costs 2 or 3.
constexpr double kNothing = 4;

class SwitchedOff : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::valgrindWorks()) GTEST_SKIP() << "valgrind is not installed: instructions cannot be counted";
  }
};

// A fixed ball that one finger presses on and slides over; only the haptic loop runs.
std::string ballScene() {
  std::ofstream(scratch("press.csv")) << "time_s,role,x_m,y_m,z_m,phase\n0,thumb,0,0,0.07,reach\n0.2,thumb,0,0,0.055,"
                                         "reach\n3,thumb,0.02,0.01,0.05,hold\n";
  std::ofstream(scratch("press.xml")) << R"(<rig version="1.0" name="press"><device role="thumb" driver="scripted">
    <set key="motion" value="press.csv"/></device></rig>)";
  std::ofstream(scratch("ball.xml")) << R"(<scene version="1.0" name="ball" rig="press.xml"><world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness="1000" damping="1"><friction static="0.4" dynamic="0.3"/></material></materials>
    <body name="ball" fixed="true"><haptic><sphere radius="0.05"/></haptic></body>
    <devices><device role="thumb"/></devices></scene>)";
  return scratch("ball.xml");
}

TickCount probe(const std::string& without, const std::string& shape, const std::string& sets = "") {
  return countPerTick(std::string(PRESA_BINARY_DIR) + "/bin/effects_probe " + ballScene() + " {ticks} " + without +
                      ' ' + shape + sets);
}

// One run switches the effect off in the scene; the other has the stage removed from its list by hand. With the effect
// on the count rises, so the measurement is sensitive.
void expectFree(const std::string& stage, const std::string& on_shape, const std::string& off_shape,
                const std::string& off_sets) {
  const TickCount off = probe("none", off_shape, off_sets), without = probe(stage, off_shape, off_sets);
  EXPECT_NEAR(off.instructions, without.instructions, kNothing) << stage;
  EXPECT_EQ(off.out, without.out) << stage;
  EXPECT_GT(probe("none", on_shape).instructions, probe(stage, on_shape).instructions + 10 * kNothing) << stage;
}

TEST_F(SwitchedOff, FrictionIsFree) {
  expectFree("friction", "as_is", "as_is", " material/wood/friction/static=0 material/wood/friction/dynamic=0");
}

TEST_F(SwitchedOff, DampingIsFree) { expectFree("damping", "as_is", "as_is", " material/wood/damping=0"); }

TEST_F(SwitchedOff, ForceShadingIsFree) { expectFree("shading", "smooth", "mesh", ""); }

// ---- plug-ins ------------------------------------------------------------------------------------------------------

/// A copy of the program with only these plug-ins.
std::string programWith(const std::vector<std::string>& plugins) {
  const fs::path from = PRESA_BINARY_DIR, to = scratch("program_of_" + std::to_string(plugins.size()));
  fs::create_directories(to / "bin");
  fs::create_directories(to / "lib/presa");
  const auto copy = [&](const std::string& file) {
    fs::copy_file(from / file, to / file, fs::copy_options::overwrite_existing);
  };
  copy("bin/presa");
  for (const auto& entry : fs::directory_iterator(from / "lib/presa")) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("libpresa_")) copy("lib/presa/" + name);
  }
  for (const std::string& plugin : plugins) {
    const std::string file = "lib/presa/presa_" + plugin;
    copy(file + ".so");
    if (fs::exists(from / (file + ".xml"))) copy(file + ".xml");
  }
  for (const char* folder : {"config", "experiments"}) {  // folders from which scenes may name rigs and motions
    if (!fs::exists(to / folder)) fs::create_directory_symlink(fs::path(PRESA_SOURCE_DIR) / folder, to / folder);
  }
  return (to / "bin/presa").string();
}

/// Instructions per tick and, in `out`, the summary's state hash.
TickCount lockstep(const std::string& program, const std::string& arguments) {
  const std::string summary = scratch("summary.json");
  TickCount result = countPerTick(program + " run " + arguments +
                                  " --lockstep --quiet --view none --for {seconds} --summary " + summary);
  std::ifstream in(summary);
  result.out = "no hash";
  for (std::string line; std::getline(in, line);) {
    if (line.find("state_hash") != std::string::npos) result.out = line;
  }
  return result;
}

// Without recording and view, a run costs the same as in a program that cannot record, show, search a mesh, or move a
// body. (Nothing moves here: ODE's heap use costs some instructions more or less depending on the address of the heap.)
TEST_F(SwitchedOff, RecordingAndViewAreFree) {
  const TickCount whole = lockstep(std::string(PRESA_BINARY_DIR) + "/bin/presa", ballScene());
  const TickCount bare =
      lockstep(programWith({"friction_cone", "god_object", "haptics_proxy", "scripted"}), ballScene());
  EXPECT_NEAR(whole.instructions, bare.instructions, kNothing);
  EXPECT_EQ(whole.out, bare.out);
  EXPECT_NE(whole.out, "no hash");
}

// Gravity acts on free bodies only: without any, a run costs the same as in a program without dynamics, at any gravity.
TEST_F(SwitchedOff, GravityIsFreeWhereNothingCanFall) {
  const std::string scene = scratch("fixed.xml");
  std::ofstream(scene) << R"(<scene version="1.0" name="fixed" rig=")" << source("config/rigs/hover.xml") << R"(">
    <world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness="2000" damping="1"><friction static="0.5"/></material></materials>
    <body name="table" fixed="true"><haptic><box size="1 1 0.02"/></haptic></body>
    <devices><device role="thumb"/><device role="index"/></devices></scene>)";
  const TickCount with = lockstep(std::string(PRESA_BINARY_DIR) + "/bin/presa", scene);
  const std::string bare_program = programWith({"friction_cone", "god_object", "haptics_proxy", "scripted"});
  const TickCount bare = lockstep(bare_program, scene);
  const TickCount weightless = lockstep(bare_program, scene + " --set world/gravity=\"0 0 0\"");
  EXPECT_NEAR(with.instructions, bare.instructions, kNothing);
  EXPECT_NEAR(weightless.instructions, bare.instructions, kNothing);
  EXPECT_EQ(with.out, bare.out);
  EXPECT_EQ(weightless.out, bare.out);
}

// A weightless cube held by two fingers costs the same as when gravity was never set, with bit-identical results. With
// gravity the trace differs, and differs again when gravity is never set: the comparison is sensitive.
// (The command lines of a pair differ in one word of equal length, so that the heap has the same address.)
TEST_F(SwitchedOff, GravityIsFreeForABodyThatIsHeld) {
  const auto held = [](const std::string& without, const std::string& gravity) {
    return countPerTick(std::string(PRESA_BINARY_DIR) + "/bin/effects_probe " + source("config/scenes/cube.xml") +
                        " {ticks} " + without + " as_is world/gravity=\"" + gravity + "\"");
  };
  const TickCount off = held("nothing", "0 0 00.00"), without = held("gravity", "0 0 00.00");
  EXPECT_NEAR(off.instructions, without.instructions, kNothing);
  EXPECT_EQ(off.out, without.out);
  const TickCount on = held("nothing", "0 0 -9.81");
  EXPECT_NE(on.out, off.out);
  EXPECT_NE(held("gravity", "0 0 -9.81").out, on.out);
}

}  // namespace
}  // namespace presa
