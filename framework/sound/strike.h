#pragma once
#include <string>
#include <vector>

namespace presa::sound {

inline constexpr int kSampleRate = 44100;    ///< [Hz]
inline constexpr double kLongestWav = 1800;  ///< [s]

/// The sound of a body that was struck: sinusoids that decay, at 1, 1.6, 2.3 and 2.9 times a frequency, the higher ones
/// weaker and shorter. Amplitude at most `loudness` in all.
struct Strike {
  double time = 0,       ///< at which it begins [s]
      frequency = 1000,  ///< of the lowest sinusoid [Hz]
      decay = 0.03,      ///< of the lowest sinusoid to 1/e [s]
      loudness = 1;      ///< of full scale [-]

  /// Time after which nothing is heard [s]: 5e-5 of the amplitude is left.
  double lasts() const { return 10 * decay; }
  /// Adds it to samples that begin at `begin` [s]; what lies outside of them is left out.
  void addTo(std::vector<float>& samples, double begin) const;
};

/// Several strikes from time 0 to the end of the last one: a WAV file of one channel with 16 bits. Strikes after
/// kLongestWav are left out.
std::string wavOf(const std::vector<Strike>& strikes);
/// Samples in the range of 16 bits; louder ones are cut.
std::string pcmOf(const std::vector<float>& samples);

}  // namespace presa::sound
