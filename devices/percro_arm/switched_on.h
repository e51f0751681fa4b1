#pragma once
#include <array>

#include "devices/percro_arm/homing.h"
#include "devices/percro_arm/simulated_arm.h"
#include "framework/core/math/random.h"

namespace presa::percro {

/// A modelled arm just switched on: it stands anywhere, its counters show anything, its markers tell where its joints are.
class SwitchedOn {
 public:
  /// `gravity`: in D [m/s^2].
  SwitchedOn(const Parameters& parameters, const Vec3& gravity, const Markers& markers, RandomStream& stream);

  /// Homes it, 90 s at most, with this in the thimble. Then the arm's encoders have the zero that was found.
  const Homing& home(const TipLoad& load);
  /// One period of that.
  void step(const TipLoad& load);

  /// The transmission loses this many counts.
  void slip(const Vec3& counts) { arm_.encoders().powerUp(zero_ += counts); }

  const Homing& homing() const { return homing_; }
  SimulatedArm& arm() { return arm_; }
  /// By how much the zero that was found is wrong, in counts of the motors.
  Vec3 zeroError() const;
  double fastest() const { return fastest_; }  ///< of the tip so far [m/s]

 private:
  void look();

  Parameters parameters_;
  Markers markers_;
  SimulatedArm arm_;
  Homing homing_;
  Vec3 zero_;  // what the counters show at q = 0
  std::array<bool, 3> covered_{};
  double fastest_ = 0;
};

}  // namespace presa::percro
