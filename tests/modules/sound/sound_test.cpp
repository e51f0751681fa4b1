// What a scene sounds like: three blocks that fall, each by its materials; played through aplay; a run without listeners.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <vector>

#include "framework/sound/strike.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

const std::string kProgram = PRESA_BINARY_DIR "/bin/presa", kAttended = " --realtime --view none ";

std::string contentsOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<double> samplesOf(const std::string& wav) {
  std::vector<double> samples;
  for (std::size_t i = 44; i + 1 < wav.size(); i += 2) {
    std::int16_t sample = 0;
    std::memcpy(&sample, &wav[i], 2);
    samples.push_back(sample / 32767.0);
  }
  return samples;
}

/// Strength of a frequency in a window of 0.1 s from that time on.
double strength(const std::vector<double>& samples, double frequency, double from) {
  std::complex<double> sum = 0;
  const auto first = static_cast<std::size_t>(from * sound::kSampleRate);
  for (std::size_t i = first; i < std::min(samples.size(), first + sound::kSampleRate / 10); ++i)
    sum +=
        samples[i] * std::polar(1.0, -2 * std::numbers::pi * frequency * static_cast<double>(i) / sound::kSampleRate);
  return std::abs(sum);
}

/// Time of the strongest window of a frequency [s].
double loudestTime(const std::vector<double>& samples, double frequency) {
  double best = 0, at = -1;
  for (double from = 0; from < static_cast<double>(samples.size()) / sound::kSampleRate; from += 0.02) {
    if (const double found = strength(samples, frequency, from); found > best) best = found, at = from;
  }
  return at;
}

class SceneWithSounds : public testing::Test {
 protected:
  SceneWithSounds() { std::filesystem::create_directories(folder_); }
  ~SceneWithSounds() override { std::filesystem::remove_all(folder_); }
  const std::string scene_ = test::source("config/scenes/sounds.xml"),
                    folder_ = testing::TempDir() + "presa_sounds_" + std::to_string(getpid());
};

// A block is pushed over the edge in its second of the motion and falls 0.1 m: 0.14 s. Before the first nothing is heard.
TEST_F(SceneWithSounds, IsHeardInItsFile) {
  const std::string wav = folder_ + "/sounds.wav";
  const test::Outcome run = test::presa("run " + scene_ + " --lockstep --view none --quiet --sound " + wav);
  ASSERT_EQ(run.status, 0) << run.err;
  const std::vector<double> samples = samplesOf(contentsOf(wav));
  ASSERT_GT(samples.size(), 4.0 * sound::kSampleRate);
  for (int i = 0; i < 0.4 * sound::kSampleRate; ++i) ASSERT_EQ(samples[static_cast<std::size_t>(i)], 0) << i;
  const double glass = loudestTime(samples, 2600), steel = loudestTime(samples, 1400), wood = loudestTime(samples, 420);
  EXPECT_GT(glass, 0.7);
  EXPECT_LT(glass, 1.8);
  EXPECT_GT(steel, 2.5);
  EXPECT_LT(steel, 3.6);
  EXPECT_GT(wood, 4.3);
  EXPECT_LT(wood, 5.4);
}

// The player is told by the script below; --realtime is a run that people attend.
TEST_F(SceneWithSounds, IsPlayedAsItHappens) {
  std::ofstream(folder_ + "/aplay") << "#!/bin/sh\nexec cat > '" << folder_ << "/played'\n";
  std::filesystem::permissions(folder_ + "/aplay", std::filesystem::perms::owner_all);
  const test::Outcome run =
      test::shell("PATH='" + folder_ + "':$PATH " + kProgram + " run " + scene_ + kAttended + "--quiet --for 2");
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string wav = std::string(44, ' ') + contentsOf(folder_ + "/played");
  EXPECT_GT(strength(samplesOf(wav), 2600, loudestTime(samplesOf(wav), 2600)), 10);
}

// The file holds what is heard in the last step, however rarely the view draws.
TEST_F(SceneWithSounds, LosesNothingToASlowView) {
  std::size_t size = 0;
  for (const std::string rate : {"60", "1"}) {
    const std::string wav = folder_ + "/view" + rate + ".wav";
    ASSERT_EQ(test::presa("run " + scene_ + " --lockstep --view none --quiet --for 1.02 --set rates/view=" + rate +
                          " --sound " + wav)
                  .status,
              0);
    const std::string text = contentsOf(wav);
    EXPECT_GT(text.size(), 1.0 * 2 * sound::kSampleRate);
    if (size > 0) {
      EXPECT_EQ(text.size(), size);
    }
    size = text.size();
  }
}

TEST_F(SceneWithSounds, ThatCannotBeWrittenIsAFault) {
  const test::Outcome run = test::presa("run " + scene_ + " --lockstep --view none --quiet --for 1 --sound /dev/full");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("no sound /dev/full: it could not be written"), std::string::npos) << run.err;
}

TEST_F(SceneWithSounds, SaysWhyNothingIsHeard) {
  const test::Outcome mute = test::shell("PATH=/nowhere " + kProgram + " run " + scene_ + kAttended + "--for 0.2");
  EXPECT_NE((mute.out + mute.err).find("aplay is not on the PATH (Debian: alsa-utils)"), std::string::npos)
      << mute.out << mute.err;
  std::ofstream(folder_ + "/aplay") << "#!/bin/sh\nexit 1\n";  // as without a sound card
  std::filesystem::permissions(folder_ + "/aplay", std::filesystem::perms::owner_all);
  const test::Outcome no_card =
      test::shell("PATH='" + folder_ + "':$PATH " + kProgram + " run " + scene_ + kAttended + "--for 0.5");
  EXPECT_NE((no_card.out + no_card.err).find("sounds were not heard: aplay ended"), std::string::npos)
      << no_card.out << no_card.err;
  const test::Outcome cube =
      test::presa("run " + test::source("config/scenes/cube.xml") + " --lockstep --sound " + folder_ + "/cube.wav");
  EXPECT_EQ(cube.status, 2);
  EXPECT_NE(cube.err.find("nothing is heard in this scene, which has no <sound>"), std::string::npos) << cube.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/cube.wav"));
}

// Whoever does not name it does not load it.
TEST_F(SceneWithSounds, AloneLoadsTheModule) {
  EXPECT_NE(test::presa("explain " + scene_).out.find("presa_sound.so"), std::string::npos);
  EXPECT_EQ(test::presa("explain " + test::source("config/scenes/cube.xml")).out.find("presa_sound.so"),
            std::string::npos);
}

}  // namespace
}  // namespace presa
