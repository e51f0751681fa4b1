#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "framework/record/record_plugin.h"
#include "framework/session/replay.h"
#include "framework/session/run.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

constexpr double kDuration = 3.5, kStall = 3.0;  // [s] the cube is held in the air

/// The pinched cube, with a haptic loop that stalls for 50 ms while the cube is held.
Recording recordStalledRun(const std::string& file, double force_share = 1) {
  Diagnostics diagnostics;
  RunOptions options;
  options.force_share = force_share;
  options.record = file;
  options.overwrite = true;
  options.duration = kDuration;
  Loaded loaded = loadWorld({test::source("config/scenes/cube.xml"), "", {}}, options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  RunControl control;
  Run run(std::move(loaded), control);
  run.lockstep().delay([](RateGroup group, double time) {
    return group == RateGroup::kHaptic && time >= kStall && time < kStall + 0.05;
  });
  run.execute();
  return recordPlugin().read(file);
}

ReplayResult again(const Recording& recording) {
  Diagnostics diagnostics;
  return RecordedRun(recording, diagnostics).run();
}

// The recording marks the catch-up ticks after a stall: with the marks every force replays bit-exactly; without them
// the slew limit acts on other ticks and the forces differ.
TEST(Replay, KnowsTheTicksThatAStallMadeUp) {
  const std::string file = test::scratch("stall.h5");
  Recording recording = recordStalledRun(file);
  auto& haptic = recording.schedule[static_cast<std::size_t>(RateGroup::kHaptic)];
  const auto catch_up =
      std::count_if(haptic.begin(), haptic.end(), [](const ScheduleRow& row) { return row.catch_up != 0; });
  EXPECT_EQ(catch_up, 50);
  // held force: constant during the stall, and changing at most at the slew limit (1000 N/s) after it
  for (std::size_t i = 1; i < recording.command.size(); ++i) {
    const double step = (recording.command[i].f_H_W[0] - recording.command[i - 1].f_H_W[0]).norm();
    ASSERT_LE(step, haptic[i].catch_up != 0 ? 0.0 : 1 + 1e-9) << recording.time[i];
  }
  const ReplayResult same = again(recording);
  EXPECT_EQ(same.problem, "");
  EXPECT_EQ(same.ticks, recording.time.size());
  EXPECT_EQ(same.differing, 0u);

  for (ScheduleRow& row : haptic) row.catch_up = 0;
  EXPECT_GT(again(recording).differing, 0u);
  std::filesystem::remove(file);
}

// Hardware without real-time rights runs with half of its force limits: the share is part of the recording.
TEST(Replay, KnowsTheShareOfTheForceThatWasAllowed) {
  Recording recording = recordStalledRun(test::scratch("share.h5"), 0.3);  // 3 N of the 6 N of the grip
  EXPECT_EQ(recording.force_share, 0.3);
  EXPECT_EQ(again(recording).differing, 0u);
  recording.force_share = 1;
  EXPECT_GT(again(recording).differing, 1000u);
}

}  // namespace
}  // namespace presa
