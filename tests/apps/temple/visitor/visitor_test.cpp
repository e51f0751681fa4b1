// Anybody's first minutes: a naive visitor with a mouse rebuilds the first task.
#include <gtest/gtest.h>

#include <cstdio>

#include "apps/common/scratch_folder.h"
#include "apps/temple/building/building.h"
#include "apps/temple/help/help_level.h"
#include "apps/temple/help/helped_finger.h"
#include "apps/temple/ruins.h"
#include "apps/temple/written_scene.h"
#include "framework/session/run.h"
#include "tests/apps/temple/visitor/naive_visitor.h"

namespace presa::temple {
namespace {

constexpr double kThreeMinutes = 180;

struct Outcome {
  std::optional<double> finished_at;
  int placed = 0;
  bool ignores = false;
  std::string diary;
};

Outcome visitFirst(std::uint64_t seed, const test::Cues& cues, bool helps) {
  Diagnostics diagnostics;
  const ScratchFolder scratch;
  const Building first = makeBuilding(shippedProportions("first", diagnostics), 0.1, seed);
  SceneSpec spec = assembled(first);
  const Ruins ruins = strewRuins(first, seed, "", {});
  for (SceneSpec::Stone& stone : spec.stones) stone.X_WB = ruins.X_WB[stone.block];
  spec.to_be_built = true;
  spec.rig = PRESA_SOURCE_DIR "/config/rigs/pointer_pair.xml";
  Loaded loaded =
      loadWorld({writeScene(first, spec, scratch.path().string()), "", {}}, {.duration = kThreeMinutes}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  auto visitor = std::make_unique<test::NaiveVisitor>(loaded.world, seed, cues);
  const test::NaiveVisitor& seen = *visitor;
  Session::Options options;
  options.open_devices = false;  // there is no window
  options.guide = true;
  options.more.push_back(std::move(visitor));
  if (helps) {
    auto help = std::make_shared<GraspHelp>(loaded.world);
    options.more.push_back(std::make_unique<HelpLevel>(loaded.world, help));
    options.wrap = [help](DeviceList devices) { return helped(std::move(devices), help); };
  }
  RunControl control;
  Run run(std::move(loaded), control, std::move(options));
  run.onPoll([&] {
    if (seen.finishedAt()) control.stop_requested = true;
  });
  run.execute();
  return {seen.finishedAt(), seen.placed(), seen.ignoresHints(), seen.diary()};
}

TEST(NaiveVisitor, Try) {
  int done = 0;
  for (std::uint64_t seed = std::getenv("SEED") ? std::atoi(std::getenv("SEED")) : 1; seed <= (std::getenv("SEED") ? std::atoi(std::getenv("SEED")) : 20); ++seed) {
    const Outcome outcome =
        visitFirst(seed, std::getenv("CUES") ? test::Cues{true, true} : test::Cues{}, std::getenv("HELP"));
    done += outcome.finished_at.has_value();
    std::printf("%2d: placed %d at %.0f s%s\n", int(seed), outcome.placed, outcome.finished_at.value_or(-1),
                outcome.ignores ? ", ignores hints" : "");
    if (std::getenv("DIARY")) std::printf("%s", outcome.diary.c_str());
  }
  std::printf("%d of 20\n", done);
}

}  // namespace
}  // namespace presa::temple
