#pragma once
#include <array>
#include <functional>

#include "devices/hand/finger_plant.h"
#include "framework/core/math/spatial.h"

namespace presa::falcon_model {

struct GripSettings {
  double mass = 0.1;            ///< grip and parts that move with it [kg]
  double damping = 1;           ///< of the device [N s/m]
  double hand_stiffness = 500;  ///< [N/m]
  double hand_damping = 10;     ///< [N s/m]
};

/// The mechanics: a grip on three legs with encoders and motors, held by a spring and damper to a point that the test
/// moves. Torques are held between requests. Thread: the owner's.
class Grip {
 public:
  using Path = std::function<Vec3(double time)>;  ///< of the hand, in D [m]

  explicit Grip(const GripSettings& settings);

  /// Power-up: counters at zero for the current pose, no encoder referenced, motors off.
  void switchOn();
  void hand(Path path) { hand_ = std::move(path); }
  /// Advances to `time` [s], which must not decrease, on a grid of kStep.
  void advance(double time);

  /// Sets the motor words of a request.
  void drive(const std::array<int, 3>& counts) { drive_ = counts; }
  void seekReferences(bool seek);
  /// References all encoders, as if the grip had been pulled out and pushed in.
  void reference();
  void loseReference(std::size_t encoder) { homed_[encoder] = passed_out_[encoder] = false; }
  void jump(std::size_t encoder, int counts) { offset_[encoder] += counts; }

  std::array<int, 3> counters() const;
  unsigned homed() const;                                     ///< one bit per encoder
  const Vec3& position() const { return plant_.position(); }  ///< in D [m]
  const Vec3& velocity() const { return plant_.velocity(); }  ///< [m/s]
  /// Force of the motors on the grip, in D [N].
  Vec3 force() const;
  /// Energy delivered to the hand so far: sum of f . dx over the steps, f held over each [J].
  double energy() const { return energy_; }
  const Mat3& rates() const { return rates_; }  ///< d(thighs)/d(position) [rad/m]

  static constexpr double kStep = 1e-4;  ///< [s]
  /// Counts at which an encoder finds its reference, on the way in.
  static constexpr std::array kReference{520, 500, 480};

 private:
  void step();
  bool place(const Vec3& p_D);
  void findReferences();
  double counted(std::size_t encoder) const;

  GripSettings settings_;
  FingerPlant plant_;
  Path hand_;
  std::int64_t steps_ = 0;
  Vec3 target_ = Vec3::Zero(), thighs_ = Vec3::Zero();
  Mat3 rates_ = Mat3::Zero();
  std::array<int, 3> drive_{}, offset_{};
  std::array<bool, 3> homed_{}, passed_out_{};
  bool seeking_ = false;
  double energy_ = 0;
};

}  // namespace presa::falcon_model
