#pragma once
#include <array>
#include <memory>
#include <optional>

#include "devices/hand/hand.h"
#include "devices/simulated_subject/model/brain.h"
#include "devices/simulated_subject/model/hand.h"
#include "framework/core/schedule/tick.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa {

/// The grasp, in the world frame, at the start.
struct Grasp {
  std::int32_t body = kNoBody;                    ///< index into Scene::bodies
  Vec3 p_WB = Vec3::Zero();                       ///< centre of the body [m]
  Vec3 inward_W = Vec3::UnitX();                  ///< inward direction of the thumb: from thumb to index, horizontal
  double width = 0;                               ///< of the object along inward_W [m]
  std::array<double, subject::kDigits> radius{};  ///< of the fingertips [m]
};

struct SubjectSettings {
  subject::Level level = subject::Level::kL0;
  std::uint64_t seed = 1, subject = 0;  ///< identity
  std::uint64_t trial = 0;              ///< names the noise of this run
  double resolution = 0;                ///< of the device [m]
  double hold = 11;                     ///< [s]; longer than a trial's 10 s, which start when the object is still
  bool eyes_closed = false;             ///< no sight while holding
  double max_grip = 9;                  ///< max grip, below the device's force limit [N]
  double reach = 0.02;                  ///< distance to the object at the start, and when the hand opens [m]
  subject::SubjectParameters parameters{};

  bool operator==(const SubjectSettings&) const = default;
};

/// One hand and brain behind two devices. Each tick is simulated once, when the first device asks for it, under what
/// both feel. The digits are in ideal devices (read, write), or wear modelled ones (feel, push). Thread: haptic;
/// nonblocking.
class SharedSubject {
 public:
  SharedSubject(const Grasp& grasp, const SubjectSettings& settings, double period);

  /// Receives the pose of the object, for the sense of sight.
  void see(const ObjectState& objects, const Tick& tick) noexcept;
  FingerInput read(int digit, const Tick& tick) noexcept;
  void write(int digit, const Vec3& f_H_W, const Tick& tick) noexcept;

  Vec3 start(int digit) const noexcept;
  /// State of a digit that wears a modelled device.
  void feel(int digit, const Fingertip& tip) noexcept;
  /// Hand::live of such a digit.
  HandPush push(int digit, const Tick& tick) noexcept;
  /// Pressed while holding with the wanted min grip: "ready".
  std::uint32_t pressed() const noexcept { return brain_.phase() == subject::Phase::kHold ? 1 : 0; }

  const subject::Brain& brain() const noexcept { return brain_; }
  const SubjectSettings& settings() const noexcept { return settings_; }
  /// Assigns a digit to a device; false when it is already taken.
  bool take(int digit) noexcept { return !std::exchange(taken_[static_cast<std::size_t>(digit)], true); }

 private:
  void advance(const Tick& tick) noexcept;
  void live(double period) noexcept;
  void plan(double period) noexcept;
  void think(double period) noexcept;
  Vec3 faceOf(int digit) const noexcept;
  void feelForce(int digit, const Vec3& f_H_W, double unnoticed) noexcept;
  Vec3 inwardOf(int digit) const noexcept { return digit == 0 ? grasp_.inward_W : Vec3(-grasp_.inward_W); }

  const Grasp grasp_;
  const SubjectSettings settings_;
  subject::Hand hand_;
  subject::Brain brain_;
  subject::Afferents afferents_;
  Tick at_;
  std::array<bool, subject::kDigits> taken_{};
  double seen_height_ = 0, staying_behind_ = 0;  // height of the object above the fingers [m]; its filtered rate [m/s]
  double seen_before_ = 0;
  std::uint64_t planned_ = 0;  // ticks for which `pushes_` was computed so far
  std::array<subject::Hand::Place, subject::kDigits> places_{};
  std::array<double, subject::kDigits> astray_{}, v_astray_{};  // across grip and height [m], [m/s]
  std::array<subject::Hand::Push, subject::kDigits> pushes_{};
};

}  // namespace presa
