#pragma once
#include <string>
#include <vector>

namespace presa::temple {

/// One stone that hits another, or the ground.
struct Hit {
  double time = 0;    ///< of the visit [s]
  double speed = 0;   ///< that the stone lost [m/s]
  double length = 0;  ///< of the stone at the size of the building: cube root of its volume [m]
};

inline constexpr int kSampleRate = 44100;  ///< [Hz]

/// The sound of a block of marble: sinusoids that decay, the lowest at c/2L as of a bar that is free at both ends, with
/// the speed of sound c in marble; louder with the speed, up to 1 m/s. Amplitude at most 1 in all.
struct StoneSound {
  static constexpr double kSpeedOfSound = 4000;  ///< in marble, 3800 to 6000 by its grain and damp [m/s]
  static constexpr double kDecay = 0.030;        ///< of the lowest sinusoid to 1/e [s]
  static constexpr double kLasts = 0.3;          ///< [s]
  static double lowest(const Hit& hit) { return kSpeedOfSound / (2 * hit.length); }
  /// Adds it to samples that begin at `begin` on the visit's clock [s]; what lies outside of them is left out.
  static void add(const Hit& hit, double begin, std::vector<float>& samples);
};

/// What a visit sounds like, from its start to its last hit: a WAV file of one channel with 16 bits. Hits after half an
/// hour are left out.
std::string wavOf(const std::vector<Hit>& hits);
/// Samples in the range of 16 bits; louder ones are cut.
std::string pcmOf(const std::vector<float>& samples);

}  // namespace presa::temple
