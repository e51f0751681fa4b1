// Anybody's first minutes: naive visitors with a mouse rebuild the first task within three minutes.
#include <gtest/gtest.h>

#include <cstdio>

#include "apps/common/scratch_folder.h"
#include "apps/temple/help/help_level.h"
#include "apps/temple/help/helped_finger.h"
#include "framework/session/run.h"
#include "tests/apps/temple/visitor/first_task.h"
#include "tests/apps/temple/visitor/naive_visitor.h"
#include "tests/support/effort.h"

namespace presa::temple {
namespace {

constexpr double kThreeMinutes = 180;
constexpr test::Cues kShipped{.shown_how = true, .drop_lines = true};

struct Outcome {
  std::optional<double> finished_at;
  int placed = 0;
  std::vector<HelpNote> notes;
  std::string diary;
};

Outcome visitFirst(std::uint64_t seed, const test::Cues& cues, bool helps, bool practised = false) {
  const ScratchFolder scratch;
  Loaded loaded = test::loadFirstTask(seed, scratch.path().string(), {.duration = kThreeMinutes});
  auto visitor = std::make_unique<test::NaiveVisitor>(loaded.world, seed, cues, practised);
  const test::NaiveVisitor& seen = *visitor;
  Session::Options options;
  options.open_devices = false;  // there is no window
  options.guide = true;
  options.more.push_back(std::move(visitor));
  HelpLevel* level = nullptr;
  if (helps) {
    auto help = std::make_shared<GraspHelp>(loaded.world);
    auto made = std::make_unique<HelpLevel>(loaded.world, help);
    level = made.get();
    options.more.push_back(std::move(made));
    options.wrap = [help](DeviceList devices) { return helped(std::move(devices), help); };
  }
  RunControl control;
  Run run(std::move(loaded), control, std::move(options));
  run.onPoll([&] {
    if (seen.finishedAt()) control.stop_requested = true;
  });
  run.execute();
  return {seen.finishedAt(), seen.placed(), level != nullptr ? level->takeNotes() : std::vector<HelpNote>{},
          seen.diary()};
}

/// Visitors with the seeds from `first` on who do not finish, with the diary of each.
int failures(std::uint64_t first, std::uint64_t count, bool helps, const test::Cues& cues) {
  int failed = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Outcome outcome = visitFirst(seed, cues, helps);
    std::printf("seed %2d: %d placed, %s\n", static_cast<int>(seed), outcome.placed,
                outcome.finished_at ? (std::to_string(std::lround(*outcome.finished_at)) + " s").c_str() : "not done");
    if (outcome.finished_at) continue;
    ++failed;
    if (helps) std::printf("%s", outcome.diary.c_str());
  }
  return failed;
}

// 19 of 20 seeds.
TEST(NaiveVisitor, FinishesTheFirstTaskWithinThreeMinutes) {
  EXPECT_LE(failures(1, unlessSanitized(20, 1), true, kShipped), 1);
}

// The model is not so able that the help does not matter.
TEST(NaiveVisitor, WithoutHelpAndWordsDoesNot) {
  constexpr int kVisitors = unlessSanitized(4, 1);
  EXPECT_EQ(failures(1, kVisitors, false, {}), kVisitors);
}

// Nor so clumsy that nothing could be learned: knowing the controls, with a still hand, it places blocks without any
// help.
TEST(NaiveVisitor, PractisedPlacesBlocksWithoutHelp) {
  int placed = 0;
  std::string diaries;
  for (std::uint64_t seed = 1; seed <= unlessSanitized(3, 1); ++seed) {
    const Outcome outcome = visitFirst(seed, kShipped, false, true);
    placed += outcome.placed;
    diaries += outcome.diary + "\n";
  }
  EXPECT_GE(placed, unlessSanitized(3, 1)) << diaries;
}

// Every placed block takes strength off the help, at least kEach.
TEST(NaiveVisitor, HelpFadesWithTheBlocks) {
  const Outcome outcome = visitFirst(1, kShipped, true);
  ASSERT_EQ(outcome.notes.size(), 3U);
  double before = 1;
  for (const HelpNote& note : outcome.notes) {
    EXPECT_NEAR(note.strength, before - (note.own ? HelpLevel::kOwn : HelpLevel::kEach), 1e-12);
    before = note.strength;
  }
}

}  // namespace
}  // namespace presa::temple
