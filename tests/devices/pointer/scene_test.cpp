// The pair in shipped scenes, in lockstep, moved by pointer states that the test writes in place of the view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/common/scratch_folder.h"
#include "framework/record/record_plugin.h"
#include "framework/session/replay.h"
#include "framework/session/run.h"
#include "tests/apps/support/support.h"
#include "tests/support/shipped_rig.h"

namespace presa {
namespace {

const std::string kScene = PRESA_SOURCE_DIR "/config/scenes/cube.xml";
const std::string kRig = PRESA_SOURCE_DIR "/config/rigs/pointer_pair.xml";
constexpr double kLift = 0.1, kWeight = 0.2 * 9.81, kHand = 300, kContact = 1000;

/// Replaces the user: over the cube, down, close, up. The mouse jumps; the hand does not.
class Hand final : public Module {
 public:
  Hand() : Module("hand", RateGroup::kView) {}
  void step(const Tick& tick) noexcept override {
    PointerState& state = pointer_.value;
    ++state.sequence;
    state.p_WT = {0, 0, tick.time < 1 ? 0.15 : tick.time < 4 ? 0.04 : 0.04 + kLift};
    state.closing = tick.time < 2 ? 0 : 1;
  }

 private:
  Out<PointerState> pointer_{*this, kPointerPort};
};

struct Lockstep {
  explicit Lockstep(const RunOptions& options = {}) {
    Diagnostics diagnostics;
    Loaded loaded = loadWorld({kScene, kRig, {}}, options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    Session::Options session_options;
    session_options.open_devices = false;  // avoids the check for a window
    session_options.more.push_back(std::make_unique<Hand>());
    run.emplace(std::move(loaded), control, std::move(session_options));
  }
  RunControl control;
  std::optional<Run> run;
};

// The lift is the distance of the hand minus the compliance of the hand and contact springs (1 N/mm, also laterally)
// under half the weight each. A fingertip that arrives with the speed of the grip overshoots the grip force by at most
// v sqrt(k m).
TEST(PointerScene, GraspsAndLiftsTheCube) {
  Lockstep lockstep({.duration = 8});
  lockstep.run->execute();
  RunResult result;
  result.world = lockstep.run->session().world();
  takeMonitor(lockstep.run->monitor(), result);
  const ObjectSummary& cube = result.objects.at(0).summary;
  EXPECT_TRUE(cube.grasped);
  EXPECT_FALSE(cube.dropped);
  EXPECT_NEAR(cube.final.z() - cube.start.z(), kLift - kWeight / 2 * (1 / kHand + 1 / kContact), 1e-5);
  for (const auto& point : result.contact_points) {
    EXPECT_GT(point.summary.max_normal_force, 5.99);
    EXPECT_LT(point.summary.max_normal_force, 6 + 0.15 * std::sqrt(kContact * 0.1));
  }
}

// The recording contains the finger positions, so a repeated run without a pointer is bit-identical.
TEST(PointerScene, ARecordingNeedsNoPointer) {
  const ScratchFolder scratch;
  RunOptions options;
  options.record = scratch.file("pointer.h5");
  options.duration = 5;
  Lockstep(options).run->execute();
  const Recording recording = recordPlugin().read(options.record);
  Diagnostics diagnostics;
  const ReplayResult result = RecordedRun(recording, diagnostics).run();
  EXPECT_EQ(result.problem, "");
  EXPECT_EQ(result.ticks, 5000u);
  EXPECT_EQ(result.differing, 0u);
}

bool hasPointer(Session& session) {
  const auto& connections = session.graph().connections();
  return std::any_of(connections.begin(), connections.end(),
                     [](const Connection& c) { return c.from->name() == kPointerPort; });
}

// A rig without this driver has no pointer port, even when a pointer state is written.
TEST(PointerScene, IsNotInTheGraphOfOtherRigs) {
  EXPECT_TRUE(hasPointer(Lockstep().run->session()));
  Diagnostics diagnostics;
  RunControl control;
  Session::Options options;
  options.more.push_back(std::make_unique<Hand>());
  Session session(loadWorld({kScene, "", {}}, {}, diagnostics), control, std::move(options));
  EXPECT_FALSE(hasPointer(session));
}

TEST(PointerScene, WithoutAWindowItSaysWhatToDo) {
  const test::Outcome outcome = test::presa("run " + kScene + " --rig " + kRig + " --view none --lockstep");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("error[E449]"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("--view window"), std::string::npos) << outcome.err;
  EXPECT_EQ(test::presa("check " + kScene + " --rig " + kRig).status, 0);
}

TEST(PointerScene, TwoFingersOnOneSideOrWithTwoGripsAreNoPair) {
  const auto codes = [](const std::string& thumb, const std::string& index) {
    Diagnostics diagnostics;
    loadWorldFromText({loadWorld({kScene, kRig, {}}, {}, diagnostics).world->scene.resolved_xml, "cube.xml",
                       "<rig version=\"1.0\" name=\"r\"><device role=\"thumb\" driver=\"pointer\">" + thumb +
                           "</device><device role=\"index\" driver=\"pointer\">" + index + "</device></rig>"},
                      {}, diagnostics);
    std::vector<int> all;
    for (const Diagnostic& finding : diagnostics.all()) all.push_back(finding.code);
    return all;
  };
  EXPECT_EQ(codes("", ""), std::vector<int>{});
  EXPECT_EQ(codes("<set key=\"side\" value=\"1\"/>", ""), std::vector<int>{456});
  EXPECT_EQ(codes("<set key=\"grip\" value=\"3\"/>", ""), std::vector<int>{455});
  EXPECT_EQ(codes("<set key=\"span\" value=\"-1\"/>", ""), std::vector<int>{403});
  EXPECT_EQ(codes("<set key=\"reach\" value=\"1\"/>", ""), std::vector<int>{401});
}

TEST(PointerScene, ItsTickNeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Diagnostics diagnostics;
  const auto device = test::firstDevice(kScene, kRig, diagnostics);
  ASSERT_TRUE(device) << diagnostics.text();
  ASSERT_TRUE(device->points());
  device->point({1, {0.1, 0, 0.2}, 1, 0.5, 0, 0, {}}, {});
  test::expectRealTime(*device);
}

}  // namespace
}  // namespace presa
