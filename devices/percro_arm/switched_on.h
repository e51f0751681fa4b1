#pragma once
#include <array>

#include "devices/percro_arm/homing.h"
#include "devices/percro_arm/simulated_arm.h"
#include "framework/core/math/random.h"

namespace presa::percro {

/// A modelled arm just after power-up: its position and counter values are random, and its markers show where the
/// joints are.
class SwitchedOn {
 public:
  /// `gravity`: in D [m/s^2].
  SwitchedOn(const Parameters& parameters, const Vec3& gravity, const Markers& markers, RandomStream& stream);

  /// Homes the arm, within 90 s at most, with this load in the thimble, and sets the encoders' zero to the result.
  const Homing& home(const TipLoad& load);
  /// One period of homing.
  void step(const TipLoad& load);

  /// Makes the transmission lose this many counts.
  void slip(const Vec3& counts) { arm_.encoders().powerUp(zero_ += counts); }

  const Homing& homing() const { return homing_; }
  SimulatedArm& arm() { return arm_; }
  /// Error of the zero found by homing, in motor counts.
  Vec3 zeroError() const;
  double fastest() const { return fastest_; }  ///< max speed of the tip so far [m/s]

 private:
  void look();

  Parameters parameters_;
  Markers markers_;
  SimulatedArm arm_;
  Homing homing_;
  Vec3 zero_;  // counter values at q = 0
  std::array<bool, 3> covered_{};
  double fastest_ = 0;
};

}  // namespace presa::percro
