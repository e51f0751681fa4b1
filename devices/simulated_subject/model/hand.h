#pragma once
#include <array>
#include <cmath>

#include "devices/simulated_subject/model/afferents.h"
#include "devices/simulated_subject/model/subject_parameters.h"
#include "framework/core/math/random.h"

namespace presa::subject {

/// Position as reported by a device with this resolution; 0: exact.
inline double quantised(double x, double step) noexcept { return step > 0 ? step * std::nearbyint(x / step) : x; }

/// Force noise of the two digits: slow noise (partly common) and 10 Hz tremor; and noise of the muscle springs' length.
class MotorNoise {
 public:
  MotorNoise(const SubjectParameters& parameters, RandomStream stream, double period);
  /// Call once per tick; new values are drawn every 5 ms.
  void step(double grip) noexcept;
  double force(int digit) const noexcept { return force_[digit]; }        ///< [N]
  double position(int digit) const noexcept { return position_[digit]; }  ///< [m]

 private:
  /// Second-order autoregression: a 10 Hz resonance, 2 Hz wide, unit variance.
  struct Tremor {
    double now = 0, before = 0;
  };
  void renew(double grip) noexcept;

  const SubjectParameters parameters_;
  RandomStream stream_;
  int ticks_per_value_, tick_ = 0;
  double keep_, add_;  // Ornstein-Uhlenbeck: x' = keep x + add e
  double tremor_now_, tremor_before_, tremor_add_;
  double shared_ = 0;
  std::array<double, kDigits> own_{}, force_{}, position_{};
  std::array<Tremor, kDigits> tremor_{};
};

/// Two digits, each a mass with muscle impedance, on one arm:
///   M q'' = gain (U + noise) + k_h (q_a + w - q) - b_h q' - N -+ k_arm (q_1 - q_2) / 2,   q_a' = (q - q_a) / tau_a
///   M y'' = k_y (y_ref - y) + u_y - b_y y' - T -+ k_level (y_1 - y_2) / 2,   u_y' = rate k_y (y_ref - mean y)
/// Anchors and sway are relative to the wanted middle of the hand. k_level keeps the digits level: an object of width 2
/// a turns between them when squeezed harder than a k (k_y + k_level) / (k + k_y + k_level). Integrated by
/// semi-implicit Euler. Thread: any, haptic included (nothing allocates).
class Hand {
 public:
  /// The digits start at rest at q, with y = 0.
  Hand(const SubjectParameters& parameters, RandomStream noise, double period, double q = 0);
  /// One period under the forces in `felt` (only normal and load are used).
  void step(const MotorCommand& command, const std::array<DigitAfferents, kDigits>& felt) noexcept;

  /// Position and velocity of a digit.
  struct Place {
    double q = 0, v_q = 0, y = 0, v_y = 0;  ///< [m] [m/s]
  };
  /// Force of the muscles on a digit, inwards and up [N].
  struct Push {
    double along = 0, up = 0;
  };
  /// One period of a hand whose digits are where a device has them: what its muscles do, instead of step().
  std::array<Push, kDigits> push(const MotorCommand& command, const std::array<Place, kDigits>& places) noexcept;

  double q(int digit) const noexcept { return digits_[digit].q; }
  double y(int digit) const noexcept { return digits_[digit].y; }
  double vQ(int digit) const noexcept { return digits_[digit].v_q; }
  double vY(int digit) const noexcept { return digits_[digit].v_y; }
  double meanHeight() const noexcept { return 0.5 * (digits_[0].y + digits_[1].y); }
  /// Common motion of both digits along the grip, in the thumb's direction [m].
  double sway() const noexcept { return 0.5 * (digits_[0].q - digits_[1].q); }
  /// Lift force commanded per digit [N].
  double effort(const MotorCommand& command) const noexcept {
    return parameters_.posture_stiffness * (command.height - meanHeight()) + lift_;
  }
  /// Places both digits at rest with squeeze depth `depth` [m], keeping the current sway.
  void place(double depth) noexcept;

 private:
  struct Digit : Place {
    double anchor = 0;
  };
  /// Push on each digit against these forces, from the present state.
  std::array<Push, kDigits> pushAgainst(const MotorCommand& command, const std::array<DigitAfferents, kDigits>& felt);
  void relax(Digit& digit) noexcept;
  void lift(const MotorCommand& command) noexcept;
  const SubjectParameters parameters_;
  const double period_, mass_;
  MotorNoise noise_;
  std::array<Digit, kDigits> digits_{};
  double lift_ = 0;  // u_y [N]
};

}  // namespace presa::subject
