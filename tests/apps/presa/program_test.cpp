#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/common/file_text.h"
#include "framework/record/record_plugin.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using test::presa;
using test::scratch;
using test::source;

const std::string kCubeScene = source("config/scenes/cube.xml");

nlohmann::json readJson(const std::string& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

// The summary has the keys of the manual, on which other programs rely.
TEST(Run, WritesTheSummaryThatIsPromised) {
  const std::string file = scratch("summary.json");
  const auto outcome = presa("run " + kCubeScene + " --lockstep --for 10 --quiet --summary " + file);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto summary = readJson(file);
  EXPECT_DOUBLE_EQ(summary.at("duration_s"), 10);
  EXPECT_EQ(summary.at("rates").at("haptic").at("ticks"), 10'000);
  EXPECT_EQ(summary.at("rates").at("dynamics").at("ticks"), 2000);
  EXPECT_EQ(summary.at("contact_points").size(), 2u);
  EXPECT_EQ(summary.at("contact_points")[0].at("name"), "thumb");
  EXPECT_EQ(summary.at("contact_points")[0].at("pop_through"), 0);
  EXPECT_EQ(summary.at("objects")[0].at("name"), "cube");
  EXPECT_NEAR(summary.at("objects")[0].at("highest_position_m")[2].get<double>(), 0.135, 0.001);
  EXPECT_EQ(summary.at("objects")[0].at("dropped"), false);
  EXPECT_TRUE(summary.at("faults").empty());
  EXPECT_EQ(summary.at("state_hash").get<std::string>().size(), 18u);
}

// ./dev run builds the listed plug-ins first: the list is complete, and making it loads none of them.
TEST(Run, NamesThePlugInsThatItWouldLoad) {
  const auto plain = presa("run " + kCubeScene + " --view none --plug-ins");
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_EQ(plain.out, "dynamics_ode\nfriction_cone\ngod_object\nhaptics_proxy\nscripted\n");
  const auto recorded = presa("run " + kCubeScene + " --view offscreen --record never.h5 --plug-ins");
  EXPECT_EQ(recorded.out,
            "checksum\ndynamics_ode\nfriction_cone\ngod_object\nhaptics_proxy\nrecord\nscripted\nview_osg\n");
  EXPECT_EQ(presa("run no_such_scene.xml --plug-ins").status, 2);
}

// The limit is meant for the fields of any renderer of tools: a scene without one has nothing that it limits.
TEST(Run, RefusesFieldsThatNeedMoreMemory) {
  const std::string little = " --lockstep --for 0.01 --quiet --memory 4";
  const auto refused = presa("run " + source("config/scenes/peg_in_hole.xml") + little);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("error[E596]"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("4 MiB are left"), std::string::npos) << refused.err;
  EXPECT_EQ(presa("run " + source("config/scenes/peg_in_hole.xml") + little + "0").status, 0);
  EXPECT_NE(presa("run " + kCubeScene + little).err.find("nothing at haptics/* has 'memory'"), std::string::npos);
}

// Very high rates, used for references, are allowed in virtual time only.
TEST(Run, RefusesRatesThatNoClockKeeps) {
  const std::string fast = "run " + kCubeScene + " --view none --quiet --for 0.01 --set rates/haptic=20000 ";
  const auto refused = presa(fast + "--realtime");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("error[E408]"), std::string::npos) << refused.err;
  EXPECT_EQ(presa(fast + "--lockstep").status, 0);
}

// Recordings of a lockstep run and of real threads with their random timing both reproduce every force.
TEST(Replay, FindsEveryForceOfARecordingAgainBitForBit) {
  for (const std::string mode : {"--lockstep", "--realtime --view none"}) {
    const std::string file = scratch("replay.h5");
    ASSERT_EQ(presa("run " + source("config/scenes/pinch_and_lift.xml") + " " + mode +
                    " --for 2.5 --quiet --overwrite --record " + file)
                  .status,
              0);
    const auto outcome = presa("replay " + file + " --verify");
    EXPECT_EQ(outcome.status, 0) << mode << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("checksum right"), std::string::npos) << outcome.out;
    const std::string ticks = std::to_string(recordPlugin().read(file).time.size());
    EXPECT_NE(outcome.out.find("verified: " + ticks + " ticks of 2 fingers, all of the recording"), std::string::npos)
        << outcome.out;
  }
}

// Verification is sensitive: with another object mass in the recorded scene the forces differ. With a checksum the
// recording is reported as damaged; in a format without checksums, as different.
TEST(Replay, NoticesADifferenceAndTellsItFromDamage) {
  const std::string file = scratch("different.h5");
  ASSERT_EQ(presa("run " + kCubeScene + " --lockstep --for 2 --quiet --overwrite --record " + file).status, 0);
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(bytes)), {});
  const auto write = [&](std::size_t at, const std::string& text) {
    ASSERT_LT(at, all.size());
    bytes.clear();
    bytes.seekp(static_cast<std::streamoff>(at));
    bytes << text << std::flush;
  };
  write(all.find("mass=\"0.2\""), "mass=\"0.3\"");  // same length, so that the bytes can be exchanged in place
  const auto damaged = presa("replay " + file + " --verify");
  EXPECT_EQ(damaged.status, 2) << damaged.out << damaged.err;
  EXPECT_NE(damaged.err.find(file + ": error[E676]"), std::string::npos) << damaged.err;
  EXPECT_EQ(damaged.out.find("verified"), std::string::npos) << damaged.out;
  // attribute message: name in 16 bytes, number type in 16, scalar space in 8, then the value
  write(all.find(std::string("format_version\0", 15)) + 40, "\x05");
  const auto different = presa("replay " + file + " --verify");
  EXPECT_EQ(different.status, 1) << different.out << different.err;
  EXPECT_NE(different.out.find("no checksum"), std::string::npos) << different.out;
  EXPECT_NE(different.out.find("NOT the same"), std::string::npos) << different.out;
}

// Libraries that a scene does not need are not mapped, as read from the process itself.
TEST(Explain, MapsOnlyWhatTheSceneCallsFor) {
  const std::string fixed = scratch("fixed.xml");
  std::ofstream(fixed) << R"(<scene version="1.0" name="fixed" rig=")" << source("config/rigs/hover.xml") << R"(">
    <world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness="2000"/></materials>
    <body name="table" fixed="true"><haptic><box size="1 1 0.1"/></haptic></body>
    <devices><device role="thumb"/><device role="index"/></devices></scene>)";
  const auto libraries = [](const std::string& scene) {
    const auto outcome = presa("explain " + scene + " --format json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out).at("libraries").dump();
  };
  const std::string bare = libraries(fixed), cube = libraries(kCubeScene),
                    mesh = libraries(source("config/scenes/pinch_and_lift.xml"));
  for (const char* absent : {"libode", "libfcl", "libosg", "libhdf5", "libassimp"}) {
    EXPECT_EQ(bare.find(absent), std::string::npos) << absent;
  }
  EXPECT_NE(cube.find("libode"), std::string::npos);
  EXPECT_EQ(cube.find("libfcl"), std::string::npos);
  EXPECT_NE(mesh.find("libfcl"), std::string::npos);
}

// What loading changed in a mesh is said where the results are kept: terminal, summary and report.
TEST(Run, SaysWhatLoadingRepaired) {
  const std::string mesh = scratch("sliver.obj"), scene = scratch("sliver.xml"), summary = scratch("sliver.json"),
                    report = scratch("sliver.html");
  // inside out, and one triangle twice through the same corner
  std::ofstream(mesh) << "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nv 0.1 0 0\n"
                         "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\nf 1 2 5\n";
  std::ofstream(scene) << R"(<scene version="1.0" name="m"><world gravity="0 0 0"/>
    <materials><material name="wood" stiffness="500"/></materials>
    <body name="b" fixed="true"><haptic><mesh file="sliver.obj"/></haptic></body></scene>)";
  const auto outcome = presa("run " + scene + " --lockstep --for 0.1 --summary " + summary + " --report " + report);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto warnings = readJson(summary).at("load_warnings");
  ASSERT_EQ(warnings.size(), 2u) << warnings.dump(2);
  for (const std::string what : {"1 degenerate triangle was dropped", "it is inside out and was turned"}) {
    EXPECT_NE(warnings.dump().find(what), std::string::npos) << what << warnings.dump(2);
    EXPECT_NE(outcome.err.find(what), std::string::npos) << what;
    EXPECT_NE(contentsOf(report).find(what), std::string::npos) << what;
  }
}

// Every kind of bad input gives exit status 2, a position and a code, and writes nothing.
TEST(BadInput, IsRefusedWithAPlaceAndNothingIsWritten) {
  const std::string zeros = scratch("zeros.obj"), bad_mesh = scratch("bad_mesh.xml"), summary = scratch("never.json");
  std::ofstream(zeros) << std::string(4096, '\0');
  std::ofstream(bad_mesh) << R"(<scene version="1.0" name="m"><world gravity="0 0 0"/>
    <materials><material name="wood" stiffness="2000"/></materials>
    <body name="b" fixed="true"><haptic><mesh file="zeros.obj"/></haptic></body></scene>)";
  const std::string garbage = scratch("garbage.xml");
  std::ofstream(garbage) << "<scene version=\"1.0\"><world gravity=\"0 0 -9.81\">";
  struct Case {
    std::string arguments, expected;
  };
  const Case cases[] = {
      {"/nowhere/scene.xml", "error[E"},
      {garbage, garbage + ":1:"},
      {bad_mesh, bad_mesh + ":3:"},
      {kCubeScene + " --set body/cub/physics/mass=1", "did you mean"},
      {kCubeScene + " --set body/cube/physics/mass=0", "error[E"},
      {kCubeScene + " --set body/cube/physics/mass=-1 --set rates/dynamics=300", "error[E"},
      {kCubeScene + " --set nonsense", "PATH=VALUE"},
      {kCubeScene + " --rig /nowhere/rig.xml", "error[E"},
      {kCubeScene + " --view none --screenshot " + scratch("x.png"), "error[E121]"},
  };
  for (const Case& bad : cases) {
    const auto outcome = presa("run " + bad.arguments + " --lockstep --summary " + summary);
    EXPECT_EQ(outcome.status, 2) << bad.arguments << outcome.err;
    EXPECT_NE(outcome.err.find(bad.expected), std::string::npos) << bad.arguments << '\n' << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(summary)) << bad.arguments;
  }
  EXPECT_EQ(presa("run").status, 2);
  EXPECT_EQ(presa("fly").status, 2);
  EXPECT_EQ(presa("--help").status, 0);
  EXPECT_EQ(presa("--version").status, 0);
}

TEST(Check, SaysThatEveryShippedSceneIsGood) {
  std::string scenes;
  for (const auto& entry : std::filesystem::directory_iterator(source("config/scenes"))) {
    if (entry.path().extension() == ".xml") scenes += ' ' + entry.path().string();
  }
  const auto outcome = presa("check" + scenes);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

// Another mesh gives other forces: a replay with it would blame the program. The recording holds the SHA-256 of each mesh.
TEST(Replay, RefusesAMeshThatIsNotTheOneOfTheRun) {
  const std::string mesh = scratch("touched.obj"), scene = scratch("touched.xml"), file = scratch("touched.h5");
  const auto copy = std::filesystem::copy_options::overwrite_existing;
  std::filesystem::copy_file(source("config/meshes/cup.obj"), mesh, copy);
  std::ofstream(scene) << R"(<scene version="1.0" name="m" rig=")" << source("config/rigs/hover.xml") << R"(">
    <world gravity="0 0 0"/><materials><material name="m" stiffness="500"/></materials><body name="cup" fixed="true">
    <haptic><mesh file="touched.obj"/></haptic></body>
    <devices><device role="thumb"/><device role="index"/></devices></scene>)";
  const auto run = presa("run " + scene + " --lockstep --for 0.2 --quiet --overwrite --record " + file);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto same = presa("replay " + file + " --verify");
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  std::ofstream(mesh, std::ios::app) << "# a comment changes no force, but the file is another\n";
  const auto other = presa("replay " + file + " --verify");
  EXPECT_EQ(other.status, 2) << other.out;
  EXPECT_NE(other.err.find("error[E679]: the mesh '"), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("touched.obj' is not the one of the run: SHA-256 "), std::string::npos) << other.err;
}

// A pipe is written to, and not replaced by a file.
TEST(Summary, GoesToAPipe) {
  const auto outcome = presa("run " + kCubeScene + " --lockstep --for 0.1 --quiet --view none --summary /dev/stdout");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out).at("duration_s"), 0.1);
}

// Ctrl-C in the middle of a real-time grasp: status 130, forces faded to zero in the recording, file complete.
TEST(Interrupt, FadesForcesAndKeepsTheRecording) {
  const std::string file = scratch("interrupted.h5");
  const auto outcome =
      test::shell("timeout --foreground --preserve-status -s INT 2.6 " + std::string(PRESA_BINARY_DIR) +
                  "/bin/presa run " + kCubeScene + " --realtime --view none --quiet --overwrite --record " + file);
  ASSERT_EQ(outcome.status, 130) << outcome.err;
  const Recording recording = recordPlugin().read(file);
  ASSERT_GT(recording.command.size(), 100u);
  EXPECT_TRUE(recording.complete);
  EXPECT_TRUE(recording.device.back().stop_requested);
  EXPECT_NE(presa("replay " + file).out.find("stopped by the user at "), std::string::npos);
  for (int f = 0; f < 2; ++f) EXPECT_EQ(recording.command.back().f_H_W[static_cast<std::size_t>(f)].norm(), 0);
}

// The forces fade for 150 ms, and a video is completed: the user reads at once what is waited for.
TEST(Interrupt, IsAnsweredBeforeTheRunHasEnded) {
  const std::string video = scratch("interrupted.mp4"), begin = "timeout --foreground --preserve-status -s TERM 2 " +
                                                                std::string(PRESA_BINARY_DIR) + "/bin/presa run " +
                                                                kCubeScene;
  const auto live = test::shell(begin + " --realtime --view none");
  EXPECT_EQ(live.status, 130) << live.err;
  EXPECT_NE(live.err.find("\nstopping: forces fade to zero\n"), std::string::npos) << live.err;
  const auto filmed = test::shell(begin + " --lockstep --overwrite --video " + video);
  EXPECT_EQ(filmed.status, 130) << filmed.err;
  EXPECT_NE(filmed.err.find("\nstopping: the video is completed\n"), std::string::npos) << filmed.err;
}

}  // namespace
}  // namespace presa
