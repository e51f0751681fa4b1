#include "framework/sound/strike.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>

namespace presa::sound {
namespace {

constexpr std::array kRatios{1.0, 1.6, 2.3, 2.9};    // of a block's other frequencies to its lowest: chosen by ear
constexpr std::array kShares{0.5, 0.25, 0.15, 0.1};  // of the amplitude
constexpr double kHighest = 12000;                   // [Hz]

void appendNumber(std::string& text, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xffU);
}

}  // namespace

void Strike::addTo(std::vector<float>& samples, double begin) const {
  const auto first = static_cast<std::ptrdiff_t>(std::ceil((time - begin) * kSampleRate));
  const auto last =
      std::min(static_cast<std::ptrdiff_t>(samples.size()), first + static_cast<std::ptrdiff_t>(lasts() * kSampleRate));
  for (std::size_t mode = 0; mode < kRatios.size(); ++mode) {
    if (kRatios[mode] * frequency > kHighest) break;
    const std::complex<double> rate(-kRatios[mode] / decay, 2 * std::numbers::pi * kRatios[mode] * frequency);
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, first);
    std::complex<double> wave =
        loudness * kShares[mode] * std::exp(rate * (begin + static_cast<double>(from) / kSampleRate - time));
    const std::complex<double> turn = std::exp(rate / static_cast<double>(kSampleRate));  // over a sample
    for (std::ptrdiff_t i = from; i < last; ++i, wave *= turn)
      samples[static_cast<std::size_t>(i)] += static_cast<float>(wave.imag());
  }
}

std::string pcmOf(const std::vector<float>& samples) {
  std::string text;
  text.reserve(2 * samples.size());
  for (const float sample : samples)
    appendNumber(text, static_cast<std::uint32_t>(std::lround(32767 * std::clamp(sample, -1.0F, 1.0F))), 2);
  return text;
}

std::string wavOf(const std::vector<Strike>& strikes) {
  double end = 0;
  for (const Strike& strike : strikes) end = std::max(end, std::min(kLongestWav, strike.time + strike.lasts()));
  std::vector<float> samples(static_cast<std::size_t>(end * kSampleRate));
  for (const Strike& strike : strikes) strike.addTo(samples, 0);
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

}  // namespace presa::sound
