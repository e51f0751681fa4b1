// Stone on stone: when it is heard, how high, how long; a WAV file that any player reads.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <thread>

#include "apps/common/file_text.h"
#include "apps/temple/sound/hit_watch.h"
#include "apps/temple/sound/loudspeaker.h"
#include "apps/temple/visit.h"
#include "apps/temple/written_scene.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

constexpr Hit kDrum{.time = 0.5, .speed = 0.4, .length = 0.65};

std::vector<float> soundOf(const Hit& hit, double seconds) {
  std::vector<float> samples(static_cast<std::size_t>(seconds * kSampleRate));
  StoneSound::add(hit, 0, samples);
  return samples;
}

/// Amplitude of a frequency between two times.
double strength(const std::vector<float>& samples, double frequency, double from, double to) {
  std::complex<double> sum = 0;
  for (auto i = static_cast<std::size_t>(from * kSampleRate); i < static_cast<std::size_t>(to * kSampleRate); ++i)
    sum += static_cast<double>(samples[i]) *
           std::polar(1.0, -2 * std::numbers::pi * frequency * static_cast<double>(i) / kSampleRate);
  return std::abs(sum);
}

// A free bar of marble 0.65 m long: c/2L = 3077 Hz is stronger than all frequencies beside it.
TEST(StoneSound, IsAsHighAsTheStoneIsShort) {
  const std::vector<float> samples = soundOf(kDrum, 1);
  const double lowest = StoneSound::kSpeedOfSound / (2 * 0.65), peak = strength(samples, lowest, 0.5, 0.8);
  for (double frequency = 200; frequency < 12000; frequency += 20) {
    if (std::abs(frequency - lowest) <= 60) continue;
    EXPECT_LT(strength(samples, frequency, 0.5, 0.8), peak) << frequency;
  }
  EXPECT_EQ(strength(samples, lowest, 0, 0.5), 0);
}

// Energy of the lowest sinusoid in windows one decay apart falls by e; the windows hold 90 periods of it, so that the
// others, which fade faster, are below 1 %.
TEST(StoneSound, Decays) {
  const std::vector<float> samples = soundOf(kDrum, 1);
  const double f = StoneSound::lowest(kDrum), d = StoneSound::kDecay;
  const double first = strength(samples, f, 0.53, 0.53 + d), next = strength(samples, f, 0.53 + d, 0.53 + 2 * d);
  EXPECT_NEAR(first / next, std::exp(1), 0.03);
}

TEST(StoneSound, IsLouderTheFasterAndNeverTooLoud) {
  Hit slow = kDrum, wild = kDrum;
  slow.speed = 0.2;
  wild.speed = 30;
  const std::vector<float> one = soundOf(kDrum, 1), half = soundOf(slow, 1), most = soundOf(wild, 1);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_NEAR(half[i], one[i] / 2, 1e-7);
    EXPECT_LE(std::abs(most[i]), 1);
  }
}

TEST(StoneSound, IsAWavFile) {
  const std::string wav = wavOf({kDrum});
  const auto number = [&](std::size_t at, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i)
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(wav[at + static_cast<std::size_t>(i)])) << (8 * i);
    return value;
  };
  EXPECT_EQ(wav.substr(0, 4) + wav.substr(8, 8) + wav.substr(36, 4), "RIFFWAVEfmt data");
  EXPECT_EQ(number(4, 4), wav.size() - 8);
  EXPECT_EQ(number(22, 2), 1U);
  EXPECT_EQ(number(24, 4), 44100U);
  EXPECT_EQ(number(28, 4), 88200U);
  EXPECT_EQ(number(34, 2), 16U);
  EXPECT_EQ(number(40, 4), wav.size() - 44);
  EXPECT_EQ(number(40, 4), 2 * static_cast<std::size_t>((0.5 + StoneSound::kLasts) * kSampleRate));
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
      if (quiet > kSampleRate / 10 && onsets++ == 0) first_at = static_cast<double>(i - 44) / 2 / kSampleRate;
      quiet = 0;
    } else {
      ++quiet;
    }
  }
  EXPECT_GE(onsets, 3);
  EXPECT_LE(onsets, 30);
  EXPECT_GT(first_at, 0.5);
}

/// A PATH with an aplay that keeps what it is given.
class LoudspeakerTest : public testing::Test {
 protected:
  LoudspeakerTest() : folder_(test::scratch("aplay")), path_(std::getenv("PATH")) {
    std::ofstream(folder_ + "/aplay") << "#!/bin/sh\necho \"$@\" > '" << folder_ << "/words'\nexec cat > '" << folder_
                                      << "/played'\n";
    std::filesystem::permissions(folder_ + "/aplay", std::filesystem::perms::owner_all);
    setenv("PATH", (folder_ + ":" + path_).c_str(), 1);
  }
  ~LoudspeakerTest() override { setenv("PATH", path_.c_str(), 1); }
  const std::string folder_, path_;
};

TEST_F(LoudspeakerTest, GivesSamplesToAplay) {
  {
    Loudspeaker loudspeaker;
    loudspeaker.play(kDrum);
    // the player has been given the whole hit
    for (int i = 0; i < 1000; ++i) {
      std::error_code none;
      const auto size = std::filesystem::file_size(folder_ + "/played", none);
      if (!none && size > 2 * 1.5 * StoneSound::kLasts * kSampleRate) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  const std::string words = contentsOf(folder_ + "/words"), played = contentsOf(folder_ + "/played");
  EXPECT_NE(words.find("-f S16_LE -c 1 -r 44100"), std::string::npos) << words;
  int loudest = 0;
  for (std::size_t i = 0; i + 1 < played.size(); i += 2) {
    std::int16_t sample = 0;
    std::memcpy(&sample, &played[i], 2);
    loudest = std::max(loudest, std::abs(static_cast<int>(sample)));
  }
  // 0.4 m/s: 0.4 of full scale if all sinusoids met at their tops
  EXPECT_GT(loudest, 0.4 * 32767 / 4);
  EXPECT_LE(loudest, 0.4 * 32767);
}

TEST_F(LoudspeakerTest, WithoutAplayIsRefusedAndSilent) {
  setenv("PATH", "/nowhere", 1);
  Diagnostics diagnostics;
  Loudspeaker::check(diagnostics);
  EXPECT_NE(diagnostics.text().find("error[E963]"), std::string::npos);
  Loudspeaker loudspeaker;
  loudspeaker.play(kDrum);
}

}  // namespace
}  // namespace presa::temple
