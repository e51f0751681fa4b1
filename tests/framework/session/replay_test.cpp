#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>

#include "apps/common/scratch_folder.h"
#include "apps/common/terminal_run.h"
#include "devices/replay/recorded_path.h"
#include "framework/device/device_modules.h"
#include "framework/record/record_plugin.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

const std::string kScene = PRESA_SOURCE_DIR "/config/scenes/cube.xml";

class Replay : public testing::Test {
 protected:
  /// Runs the cube, recorded as `name`; returns the result's faults.
  std::unique_ptr<TerminalRun> run(const std::string& rig, const std::string& name,
                                   const std::vector<std::string>& sets = {}) {
    Diagnostics diagnostics;
    RunOptions options;
    options.duration = 0;
    options.record = file(name);
    Loaded loaded = loadWorld({kScene, rig, sets}, options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    auto done = std::make_unique<TerminalRun>(std::move(loaded),
                                              TerminalRun::Settings{.trace_rate = 0, .quiet = true, .command = ""});
    done->execute();
    return done;
  }
  std::string rig(const std::string& thumb, const std::string& index, const std::string& name = "rig.xml") {
    std::ofstream(file(name)) << "<?xml version=\"1.0\"?>\n<rig version=\"1.0\" name=\"again\">\n"
                              << "<device role=\"thumb\" driver=\"replay\">\n"
                              << thumb << "</device>\n"
                              << "<device role=\"index\" driver=\"replay\">\n"
                              << index << "</device>\n</rig>\n";
    return file(name);
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  Diagnostics findings(const std::string& rig_file) {
    Diagnostics diagnostics;
    loadWorld({kScene, rig_file, {}}, {}, diagnostics);
    return diagnostics;
  }

  ScratchFolder folder_;
};

const std::string kWhole = "<set key=\"file\" value=\"first.h5\"/>\n";

bool sameBits(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

TEST_F(Replay, TheSameSceneCommandsTheSameForcesToTheBit) {
  run("", "first.h5");
  const auto again = run(rig(kWhole, kWhole), "second.h5");
  const Recording a = recordPlugin().read(file("first.h5")), b = recordPlugin().read(file("second.h5"));
  ASSERT_EQ(a.time.size(), b.time.size());
  std::size_t pressed = 0;
  for (std::size_t i = 0; i < a.time.size(); ++i) {
    for (std::size_t f = 0; f < 2; ++f) {
      ASSERT_TRUE(sameBits(a.command[i].f_H_W[f], b.command[i].f_H_W[f])) << "tick " << i << ", finger " << f;
      ASSERT_TRUE(sameBits(a.device[i].fingers[f].p_WH, b.device[i].fingers[f].p_WH)) << i;
      if (a.command[i].f_H_W[f].norm() > 1) ++pressed;
    }
  }
  EXPECT_GT(pressed, 8000u);
  EXPECT_TRUE(again->result().faults.empty());
  ASSERT_FALSE(again->result().phases.empty());
  EXPECT_NEAR(again->result().phases.back().end, static_cast<double>(a.time.size()) * 1e-3, 1e-9);
}

// The hand's motion is given: it presses 6 mm deep at 1 N/mm and at 0.5 N/mm, with half the force.
TEST_F(Replay, TheSameMotionAgainstASofterCubeGivesLessForce) {
  run("", "first.h5");
  run(rig(kWhole, kWhole), "softer.h5", {"material/rubber/stiffness=500"});
  const RecordedSamples a = recordPlugin().samples(file("first.h5")), b = recordPlugin().samples(file("softer.h5"));
  const std::size_t holding = 5000;  // 5 s: at rest in the air
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(a.fingers[f].values("p_WH_x")[holding], b.fingers[f].values("p_WH_x")[holding]);
    const double then = a.fingers[f].values("normal_force")[holding],
                 now = b.fingers[f].values("normal_force")[holding];
    EXPECT_NEAR(then, 6, 0.1);
    EXPECT_NEAR(now / then, 0.5, 0.01);
  }
}

TEST_F(Replay, AnotherRateIsInterpolatedAndSaidSo) {
  run("", "first.h5");
  const auto faster = run(rig(kWhole, kWhole), "faster.h5", {"rates/haptic=2000"});
  const RecordedSamples a = recordPlugin().samples(file("first.h5")), b = recordPlugin().samples(file("faster.h5"));
  const auto &x = a.fingers[0].values("p_WH_x"), &y = b.fingers[0].values("p_WH_x");
  for (std::size_t i = 0; i + 1 < a.time.size(); ++i) {
    ASSERT_EQ(y[2 * i], x[i]) << i;
    ASSERT_NEAR(y[2 * i + 1], (x[i] + x[i + 1]) / 2, 1e-15) << i;
  }
  std::size_t said = 0;
  for (const std::string& note : faster->result().notes)
    if (note.find("straight lines join") != std::string::npos) ++said;
  EXPECT_EQ(said, 2u);
}

TEST_F(Replay, AtTheEndAFingerStaysOrIsLost) {
  run("", "first.h5");
  for (const bool lost : {false, true}) {
    const std::string end = lost ? kWhole + "<set key=\"at_end\" value=\"lost\"/>\n" : kWhole;
    Diagnostics diagnostics;
    const Loaded loaded = loadWorld({kScene, rig(end, end), {}}, {}, diagnostics);
    ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
    const DeviceList& fingers = loaded.devices;
    const double over = fingers[0]->phaseTimes().back();
    const auto at = [&](double time) {
      return fingers[0]->read({static_cast<std::uint64_t>(std::lround(time * 1000)), time, 1e-3});
    };
    const FingerInput last = at(over - 1e-3), after = at(over), later = at(over + 60);
    EXPECT_TRUE(last.valid);
    EXPECT_FALSE(last.lost);
    for (const FingerInput& input : {after, later}) {
      EXPECT_EQ(input.valid, !lost);
      EXPECT_EQ(input.lost, lost);
      EXPECT_EQ(input.p_WH, last.p_WH);
      EXPECT_EQ(input.v_WH, Vec3(Vec3::Zero()));
    }
  }
}

TEST_F(Replay, NamesEveryMistakeWithItsLine) {
  run("", "first.h5");
  std::ofstream(file("not.h5")) << "no recording";
  const auto expect = [&](const std::string& thumb, int code, int line) {
    const Diagnostics diagnostics = findings(rig(thumb, kWhole));
    ASSERT_EQ(diagnostics.errorCount(), 1u) << diagnostics.text();
    EXPECT_EQ(diagnostics.all()[0].code, code) << diagnostics.text();
    EXPECT_EQ(diagnostics.all()[0].where.line, line) << diagnostics.text();
    EXPECT_EQ(diagnostics.all()[0].where.file, file("rig.xml"));
  };
  expect("", 440, 3);
  expect("<set key=\"file\" value=\"absent.h5\"/>\n", 441, 4);
  expect("<set key=\"file\" value=\"not.h5\"/>\n", 441, 4);
  expect(kWhole + "<set key=\"role\" value=\"tumb\"/>\n", 442, 5);
  expect(kWhole + "<set key=\"speed\" value=\"fast\"/>\n", 444, 5);
  expect(kWhole + "<set key=\"at_end\" value=\"stop\"/>\n", 444, 5);
  expect(kWhole + "<set key=\"motion\" value=\"x.xml\"/>\n", 401, 5);
}

RecordedPath line() {
  RecordedPath path;
  path.period = 0.01;
  for (int i = 0; i < 5; ++i) {
    FingerInput sample;
    sample.p_WH = {0.1 * i, 0, 0};
    sample.v_WH = {10, 0, 0};
    sample.valid = i != 3;
    path.rows.push_back({0.01 * i, sample});
  }
  return path;
}

// A path of constant speed: positions between rows are interpolated, but not next to a row that is not usable.
TEST(RecordedPath, IsOnTheStraightLineBetweenUsableRows) {
  const RecordedPath path = line();
  PathReader reader(path, 1);
  for (const double t : {0.0, 0.003, 0.0071, 0.01, 0.0199}) EXPECT_NEAR(reader.at(t).p_WH.x(), 10 * t, 1e-15) << t;
  EXPECT_NEAR(reader.at(0.025).p_WH.x(), 0.2, 1e-15);
  EXPECT_FALSE(reader.at(0.035).valid);
  EXPECT_TRUE(reader.at(0.04).valid);
  EXPECT_FALSE(reader.ended(0.0499));
  EXPECT_TRUE(reader.ended(0.05));
  PathReader slow(path, 0.5);
  EXPECT_NEAR(slow.at(0.03).p_WH.x(), 0.15, 1e-15);
  EXPECT_NEAR(slow.at(0.03).v_WH.x(), 5, 1e-15);
}

TEST(RecordedPath, ReadingNeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  const RecordedPath path = line();
  PathReader reader(path, 1);
  const RealTimeGuard guard;
  for (int i = 0; i < 60; ++i) reader.at(i * 1e-3);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace
}  // namespace presa
