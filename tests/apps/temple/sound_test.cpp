// Stone on stone: how high it sounds, and when it is heard.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "apps/common/file_text.h"
#include "apps/temple/sound/hit_watch.h"
#include "apps/temple/sound/stone_sound.h"
#include "apps/temple/visit.h"
#include "apps/temple/written_scene.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

// A free bar of marble 0.65 m long: c/2L = 3077 Hz.
TEST(StoneSound, IsAsHighAsTheStoneIsShortAndAsLoudAsItIsFast) {
  const sound::Strike drum = strikeOf({.time = 0.5, .speed = 0.4, .length = 0.65});
  EXPECT_EQ(drum.time, 0.5);
  EXPECT_NEAR(drum.frequency, 3077, 1);
  EXPECT_EQ(drum.loudness, 0.4);
  EXPECT_EQ(strikeOf({.time = 0, .speed = 30, .length = 0.65}).loudness, 1);
}

// The three blocks of the first task are rebuilt: each is heard, none before the first touch, and no more often than a
// few times for each block; then the next task is offered and begins a minute after the last stone.
TEST(FirstTask, IsHeardCountedAndFollowedByTheNext) {
  const Building first = test::shippedBuilding("first");
  SceneSpec spec = assembled(first);
  double x = -0.14;
  for (SceneSpec::Stone& stone : spec.stones) {
    stone.X_WB = {{x, -0.03, first.blocks[stone.block].X_WB.p.z() - 3 * 0.25 * 0.024}, Quat::Identity()};
    const Shape& shape = first.blocks[stone.block].physics;
    stone.X_WB.p.z() =
        (std::holds_alternative<Box>(shape) ? std::get<Box>(shape).size.z() : std::get<Cylinder>(shape).length) / 2;
    x += 0.14;
  }
  spec.to_be_built = true;
  spec.rig = PRESA_SOURCE_DIR "/config/rigs/assembling_pair.xml";
  const std::string folder = test::scratch("heard");
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 600;
  Loaded loaded = loadWorld({writeScene(first, spec, folder + "/scene"), "", {}}, options, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  VisitSettings settings{.quiet = true};
  settings.sound_file = folder + "/stones.wav";
  settings.counts = folder + "/visits.csv";
  settings.start.size = "first";
  settings.task = taskWords("en", "first");
  settings.next = taskWords("en", "column");
  settings.full_size = 0.317 / 0.024;
  const VisitEnd end = visit(std::move(loaded), settings);
  EXPECT_EQ(end.rebuilt.placed, 3);
  EXPECT_TRUE(end.onward);
  const std::string counted = contentsOf(settings.counts), wav = contentsOf(settings.sound_file);
  ASSERT_NE(counted.find(",first,begun,0\n"), std::string::npos) << counted;
  const std::size_t at = counted.find(",first,finished,");
  ASSERT_NE(at, std::string::npos) << counted;
  EXPECT_EQ(counted.find("left"), std::string::npos) << counted;
  // it took so long from the first touch; a minute later the visit ended, and before the touch is the approach
  EXPECT_LT(std::atof(counted.c_str() + at + 16) + 60, end.rebuilt.simulated_seconds);
  // silence and sound: onsets are samples above a thousandth after 0.1 s below it
  int onsets = 0, quiet = 0;
  double first_at = 0;
  for (std::size_t i = 44; i + 1 < wav.size(); i += 2) {
    std::int16_t sample = 0;
    std::memcpy(&sample, &wav[i], 2);
    if (std::abs(sample) > 33) {
      if (quiet > sound::kSampleRate / 10 && onsets++ == 0)
        first_at = static_cast<double>(i - 44) / 2 / sound::kSampleRate;
      quiet = 0;
    } else {
      ++quiet;
    }
  }
  EXPECT_GE(onsets, 3);
  EXPECT_LE(onsets, 30);
  EXPECT_GT(first_at, 0.5);
}

}  // namespace
}  // namespace presa::temple
