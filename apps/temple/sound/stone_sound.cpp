#include "apps/temple/sound/stone_sound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace presa::temple {
namespace {

constexpr double kLongest = 1800;                    // of a WAV file [s]
constexpr std::array kRatios{1.0, 1.6, 2.3, 2.9};    // of a block's other frequencies to its lowest: chosen by ear
constexpr std::array kShares{0.5, 0.25, 0.15, 0.1};  // of the amplitude
constexpr double kHighest = 12000;                   // [Hz]

void appendNumber(std::string& text, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xffU);
}

}  // namespace

void StoneSound::add(const Hit& hit, double begin, std::vector<float>& samples) {
  const double loud = std::min(1.0, hit.speed);
  const auto first = static_cast<std::ptrdiff_t>(std::ceil((hit.time - begin) * kSampleRate));
  const auto last =
      std::min(static_cast<std::ptrdiff_t>(samples.size()), first + static_cast<std::ptrdiff_t>(kLasts * kSampleRate));
  for (std::size_t mode = 0; mode < kRatios.size(); ++mode) {
    const double frequency = kRatios[mode] * lowest(hit);
    if (frequency > kHighest) break;
    const double turn = 2 * std::numbers::pi * frequency, decay = kRatios[mode] / kDecay;
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, first); i < last; ++i) {
      const double t = begin + static_cast<double>(i) / kSampleRate - hit.time;
      samples[static_cast<std::size_t>(i)] +=
          static_cast<float>(loud * kShares[mode] * std::exp(-decay * t) * std::sin(turn * t));
    }
  }
}

std::string pcmOf(const std::vector<float>& samples) {
  std::string text;
  text.reserve(2 * samples.size());
  for (const float sample : samples)
    appendNumber(text, static_cast<std::uint32_t>(std::lround(32767 * std::clamp(sample, -1.0F, 1.0F))), 2);
  return text;
}

std::string wavOf(const std::vector<Hit>& hits) {
  double end = 0;
  for (const Hit& hit : hits) end = std::max(end, std::min(kLongest, hit.time + StoneSound::kLasts));
  std::vector<float> samples(static_cast<std::size_t>(end * kSampleRate));
  for (const Hit& hit : hits) StoneSound::add(hit, 0, samples);
  const std::string pcm = pcmOf(samples);
  const auto bytes = static_cast<std::uint32_t>(pcm.size());
  std::string text = "RIFF";
  appendNumber(text, 36 + bytes, 4);
  text += "WAVEfmt ";
  appendNumber(text, 16, 4);
  appendNumber(text, 1, 2);  // PCM
  appendNumber(text, 1, 2);  // channels
  appendNumber(text, kSampleRate, 4);
  appendNumber(text, 2 * kSampleRate, 4);
  appendNumber(text, 2, 2);
  appendNumber(text, 16, 2);
  text += "data";
  appendNumber(text, bytes, 4);
  return text + pcm;
}

}  // namespace presa::temple
