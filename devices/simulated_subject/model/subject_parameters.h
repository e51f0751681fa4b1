#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "framework/core/math/random.h"

/// A model of a person who grips an object with thumb and index through two force-feedback thimbles. It is a model and
/// not a person; every output with its numbers must say so.
namespace presa::subject {

/// Limits of the subject's force control. None was fitted to the correlations observed in people.
enum class Level : std::uint8_t {
  kL0,  ///< the device's position steps only (dF = k dX)
  kL1,  ///< also the resolution of human finger position
  kL2,  ///< also the hand commands a finger position (equilibrium point) instead of a force
};
std::optional<Level> levelNamed(std::string_view name) noexcept;
std::string_view nameOf(Level level) noexcept;

/// One subject. SI units; sources in subject_parameters.cpp.
struct SubjectParameters {
  double hand_mass = 0, device_mass = 0;              ///< moving mass of a finger; mass added by the device [kg]
  double grip_stiffness = 0, grip_damping = 0;        ///< of a finger along the grip [N/m, N s/m]
  double arm_stiffness = 0;                           ///< of the arm along the grip [N/m]
  double posture_stiffness = 0, posture_damping = 0;  ///< of a finger along the vertical [N/m, N s/m]
  double level_stiffness = 0;                         ///< keeps the digits level [N/m]
  double muscle_time = 0;        ///< time constant of the muscle spring's length [s]; 0: constant (equilibrium point)
  double force_cv = 0;           ///< slow force noise, standard deviation over mean
  double force_noise = 0;        ///< additive slow force noise [N]
  double noise_time = 0;         ///< correlation time of slow noise [s]
  double noise_shared = 0;       ///< share of its variance common to both digits
  double tremor = 0;             ///< 10 Hz force tremor, standard deviation over mean
  double position_noise = 0;     ///< sd of the muscle spring's length [m]
  double force_weber = 0;        ///< just noticeable difference of force, relative
  double slip_threshold = 0;     ///< upward kick of the fingers that is noticed as slip [m]
  double slip_threshold_sd = 0;  ///< of its logarithm from trial to trial
  double seen_slip = 0;          ///< fall that is seen as slip [m]; 0: not watched
  double reaction = 0, seen_reaction = 0;  ///< voluntary reaction to a felt and to a seen slip [s]
  double loosening = 0;                    ///< relative rate of loosening the grip [1/s]
  double safety_margin = 0;                ///< wanted, (grip - slip force) / grip
  double clearance = 0;                    ///< safety distance from slip, in sd of the own force uncertainty
  double counts_device = 0;                ///< 1: that uncertainty includes the device's position steps; 0: it does not
  double finger_resolution = 0;            ///< own position resolution included in that uncertainty [m]
  double extra_grip = 0;                   ///< constant addition [N]
  double trial_sd = 0;                     ///< scatter of the logarithm of the wanted grip from trial to trial

  bool operator==(const SubjectParameters&) const = default;
};

/// Distribution of a quantity over a population.
struct Spread {
  enum class Kind : std::uint8_t { kConstant, kUniform, kLogNormal, kAbsNormal } kind = Kind::kConstant;
  double a = 0, b = 0;  ///< value | low, high | median, sd of log | mean, sd

  double draw(RandomStream& stream) const;
};
constexpr Spread constant(double value) { return {Spread::Kind::kConstant, value, 0}; }
constexpr Spread uniform(double low, double high) { return {Spread::Kind::kUniform, low, high}; }
constexpr Spread logNormal(double median, double sd) { return {Spread::Kind::kLogNormal, median, sd}; }
constexpr Spread absNormal(double mean, double sd) { return {Spread::Kind::kAbsNormal, mean, sd}; }

/// One parameter of a population, as listed with the data.
struct SubjectParameter {
  std::string_view name, unit;
  double SubjectParameters::*value;
  Spread spread;
  std::string_view source;  ///< origin of the spread; begins with GUESS when there is none
};

/// One number per subject and trial, to name random streams.
constexpr std::uint64_t itemOf(std::uint64_t subject, std::uint64_t trial) { return (subject << 32) + trial; }

/// Fingertip resolution of the device, drawn for each trial [m]: 55 to 130 um [Bergamasco et al., section 2.2].
inline constexpr Spread kDeviceResolution = uniform(55e-6, 130e-6);

/// The device resolution of a trial, from its own random stream.
double drawResolution(std::uint64_t seed, std::uint64_t subject, std::uint64_t trial);

class Population {
 public:
  explicit Population(Level level);
  std::span<const SubjectParameter> parameters() const& noexcept { return parameters_; }
  std::span<const SubjectParameter> parameters() const&& = delete;  ///< a loop over those of a temporary outlives it
  /// Replaces the spread of a parameter; false when there is no such parameter.
  bool set(std::string_view name, Spread spread) noexcept;
  /// Turns off motor noise and misjudgement, and the allowance for them: mechanics only.
  void silence() noexcept;
  /// Equal seed and subject give the same person at every level.
  SubjectParameters draw(std::uint64_t seed, std::uint64_t subject) const;

  static constexpr std::size_t kCount = 28;

 private:
  std::array<SubjectParameter, kCount> parameters_;
};

}  // namespace presa::subject
