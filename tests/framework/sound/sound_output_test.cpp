// Strikes: how high, how long, how loud; a WAV file that any player reads; samples that reach the player.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <thread>

#include "framework/sound/loudspeaker.h"
#include "framework/sound/strike.h"

namespace presa::sound {
namespace {

constexpr Strike kStrike{.time = 0.5, .frequency = 3000, .decay = 0.03, .loudness = 0.4};

std::vector<float> soundOf(const Strike& strike, double seconds) {
  std::vector<float> samples(static_cast<std::size_t>(seconds * kSampleRate));
  strike.addTo(samples, 0);
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

TEST(Strike, SoundsAtItsFrequencyFromItsTimeOn) {
  const std::vector<float> samples = soundOf(kStrike, 1);
  const double peak = strength(samples, kStrike.frequency, 0.5, 0.8);
  for (double frequency = 200; frequency < 12000; frequency += 20) {
    if (std::abs(frequency - kStrike.frequency) <= 60) continue;
    EXPECT_LT(strength(samples, frequency, 0.5, 0.8), peak) << frequency;
  }
  EXPECT_EQ(strength(samples, kStrike.frequency, 0, 0.5), 0);
}

// Energy of the lowest sinusoid in windows one decay apart falls by e; the windows hold 90 periods of it, so that the
// others, which fade faster, are below 1 %.
TEST(Strike, Decays) {
  const std::vector<float> samples = soundOf(kStrike, 1);
  const double f = kStrike.frequency, d = kStrike.decay;
  const double first = strength(samples, f, 0.53, 0.53 + d), next = strength(samples, f, 0.53 + d, 0.53 + 2 * d);
  EXPECT_NEAR(first / next, std::exp(1), 0.03);
}

TEST(Strike, IsAsLoudAsItSays) {
  Strike quiet = kStrike, full = kStrike;
  quiet.loudness = 0.2;
  full.loudness = 1;
  const std::vector<float> one = soundOf(kStrike, 1), half = soundOf(quiet, 1), most = soundOf(full, 1);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_NEAR(half[i], one[i] / 2, 1e-7);
    EXPECT_LE(std::abs(most[i]), 1);
  }
}

TEST(Strike, IsAWavFile) {
  const std::string wav = wavOf({kStrike});
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
  EXPECT_EQ(number(40, 4), 2 * static_cast<std::size_t>((kStrike.time + kStrike.lasts()) * kSampleRate));
}

std::string contentsOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int loudestOf(const std::string& pcm) {
  int loudest = 0;
  for (std::size_t i = 0; i + 1 < pcm.size(); i += 2) {
    std::int16_t sample = 0;
    std::memcpy(&sample, &pcm[i], 2);
    loudest = std::max(loudest, std::abs(static_cast<int>(sample)));
  }
  return loudest;
}

/// A folder for what is played, and the environment as it was afterwards.
class LoudspeakerTest : public testing::Test {
 protected:
  LoudspeakerTest() { std::filesystem::create_directories(folder_); }
  ~LoudspeakerTest() override {
    setenv("PATH", path_.c_str(), 1);
    unsetenv("ALSA_CONFIG_PATH");
    std::filesystem::remove_all(folder_);
  }
  /// Plays the strike until the player has been given all of it.
  std::string playedTo(const std::string& file) const {
    Loudspeaker loudspeaker;
    loudspeaker.play(kStrike);
    for (int i = 0; i < 1000; ++i) {
      std::error_code none;
      const auto size = std::filesystem::file_size(file, none);
      if (!none && static_cast<double>(size) > 2 * 1.5 * kStrike.lasts() * kSampleRate) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return contentsOf(file);
  }

  const std::string folder_ = testing::TempDir() + "presa_loudspeaker_" + std::to_string(getpid()),
                    path_ = std::getenv("PATH");
};

// An aplay that keeps its words and what it is given.
TEST_F(LoudspeakerTest, GivesSamplesToAplay) {
  std::ofstream(folder_ + "/aplay") << "#!/bin/sh\necho \"$@\" > '" << folder_ << "/words'\nexec cat > '" << folder_
                                    << "/played'\n";
  std::filesystem::permissions(folder_ + "/aplay", std::filesystem::perms::owner_all);
  setenv("PATH", (folder_ + ":" + path_).c_str(), 1);
  const std::string played = playedTo(folder_ + "/played"), words = contentsOf(folder_ + "/words");
  EXPECT_NE(words.find("-f S16_LE -c 1 -r 44100"), std::string::npos) << words;
  // 0.4 of full scale if all sinusoids met at their tops
  EXPECT_GT(loudestOf(played), 0.4 * 32767 / 4);
  EXPECT_LE(loudestOf(played), 0.4 * 32767);
}

// The real aplay and the real ALSA, whose card is a file.
TEST_F(LoudspeakerTest, IsHeardThroughAlsa) {
  std::ofstream(folder_ + "/alsa.conf")
      << "pcm.card { type null }\npcm.!default { type file slave.pcm card format raw file \"" << folder_
      << "/heard\" }\n";
  setenv("ALSA_CONFIG_PATH", (folder_ + "/alsa.conf").c_str(), 1);
  const std::string heard = playedTo(folder_ + "/heard");
  EXPECT_GT(loudestOf(heard), 0.4 * 32767 / 4);
  EXPECT_LE(loudestOf(heard), 0.4 * 32767);
}

TEST_F(LoudspeakerTest, WithoutAplayIsSilent) {
  setenv("PATH", "/nowhere", 1);
  Loudspeaker loudspeaker;
  loudspeaker.play(kStrike);
}

}  // namespace
}  // namespace presa::sound
