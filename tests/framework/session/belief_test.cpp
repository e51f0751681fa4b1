// Replay and page of recordings with contents that no run writes.
#include <gtest/gtest.h>

#include "apps/common/report/recording_page.h"
#include "apps/common/scratch_folder.h"
#include "apps/common/terminal_run.h"
#include "framework/record/record_plugin.h"
#include "framework/session/replay.h"

namespace presa {
namespace {

class Belief : public testing::Test {
 protected:
  void SetUp() override {
    Diagnostics diagnostics;
    RunOptions options;
    options.duration = 1;
    options.record = folder_.file("run.h5");
    Loaded loaded = loadWorld({PRESA_SOURCE_DIR "/config/scenes/cube.xml", "", {}}, options, diagnostics);
    TerminalRun(std::move(loaded), TerminalRun::Settings{.trace_rate = 0, .quiet = true, .command = ""}).execute();
    recording_ = recordPlugin().read(options.record);
  }
  /// Codes of the findings that prevent a replay.
  std::vector<int> refusals() const {
    Diagnostics diagnostics;
    const RecordedRun run(recording_, diagnostics);
    std::vector<int> codes;
    for (const Diagnostic& one : diagnostics.all())
      if (one.severity == Diagnostic::Severity::kError) codes.push_back(one.code);
    return codes;
  }
  ReplayResult again() const {
    Diagnostics diagnostics;
    return RecordedRun(recording_, diagnostics).run();
  }
  const ScratchFolder folder_;
  Recording recording_;
};

TEST_F(Belief, VerifiedIsEveryTickOfEveryFinger) {
  const ReplayResult result = again();
  EXPECT_TRUE(result.verified());
  EXPECT_EQ(result.ticks, recording_.time.size());
  EXPECT_EQ(result.recorded, recording_.time.size());
  EXPECT_EQ(result.fingers, 2u);
}

TEST_F(Belief, APartIsNotVerified) {
  recording_.schedule[0].resize(500);
  const ReplayResult result = again();
  EXPECT_EQ(result.differing, 0u);
  EXPECT_EQ(result.ticks, 500u);
  EXPECT_FALSE(result.verified());
}

TEST_F(Belief, AForceOfTheLastTickIsCompared) {
  recording_.command.back().f_H_W[1].z() += 1e-12;
  const ReplayResult result = again();
  EXPECT_EQ(result.differing, 1u);
  EXPECT_FALSE(result.verified());
}

// Without fingers of its own a session would open the devices of the recorded rig.
TEST_F(Belief, FingersBodiesAndRateAreThoseOfTheScene) {
  EXPECT_TRUE(refusals().empty());
  const Recording whole = recording_;
  recording_.fingers = 0;
  EXPECT_EQ(refusals(), std::vector<int>{677});
  recording_ = whole;
  recording_.bodies = 5;
  recording_.haptic_period = 0.002;
  EXPECT_EQ(refusals(), (std::vector<int>{677, 677}));
  recording_ = whole;
  recording_.commands.push_back({3, 95, 1.0});
  EXPECT_EQ(refusals(), std::vector<int>{677});
}

// The start time was written into the page unescaped, so that a script in it ran.
TEST_F(Belief, NothingOfARecordingIsMarkupOnItsPage) {
  RecordedSamples samples = recordPlugin().samples(folder_.file("run.h5"));
  const std::string attack = "<script>alert(1)</script><img src=x onerror=\"alert('2')\">&";
  const auto tags = [](const std::string& page) {
    std::size_t count = 0;
    for (const char* tag : {"<script", "<img", "onerror=\""})
      for (std::size_t at = page.find(tag); at != std::string::npos; at = page.find(tag, at + 1)) ++count;
    return count;
  };
  const std::size_t before = tags(recordingPage("run.h5", samples));
  samples.start_utc = samples.scene_file = attack;
  samples.faults = {attack, attack};
  for (RecordedTable& finger : samples.fingers) finger.name = attack;
  const std::string page = recordingPage(attack, samples);
  EXPECT_EQ(tags(page), before);
  EXPECT_NE(page.find("&lt;script&gt;alert(1)"), std::string::npos);
}

}  // namespace
}  // namespace presa
