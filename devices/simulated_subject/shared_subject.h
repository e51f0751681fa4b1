#pragma once
#include <array>
#include <memory>
#include <optional>

#include "framework/scene/world.h"
#include "framework/core/schedule/tick.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "devices/simulated_subject/model/brain.h"
#include "devices/simulated_subject/model/hand.h"

namespace presa {

/// How the subject grips what: all in the world, at the start.
struct Grasp {
  std::int32_t body = kNoBody;                    ///< index into Scene::bodies
  Vec3 p_WB = Vec3::Zero();                       ///< its centre [m]
  Vec3 inward_W = Vec3::UnitX();                  ///< of the thumb: from thumb to index, horizontal
  double width = 0;                               ///< of the object along it [m]
  std::array<double, subject::kDigits> radius{};  ///< of the fingertips [m]
};

struct SubjectSettings {
  subject::Level level = subject::Level::kL0;
  std::uint64_t seed = 1, subject = 0;  ///< who it is
  std::uint64_t trial = 0;              ///< names the noise of this run
  double resolution = 0;                ///< of the device [m]
  double hold = 11;                     ///< [s]: a trial that asks for 10 s first waits until the object is still
  bool eyes_closed = false;             ///< while it holds: what it notices then it has felt
  double most_grip = 9;                 ///< of what the device can push against [N]
  double reach = 0.02;                  ///< way to the object at the start, and when the hand opens [m]
  subject::Traits traits{};

  bool operator==(const SubjectSettings&) const = default;
};

/// One person's hand and brain behind two devices. Each tick is lived once, by whichever device asks first, under the forces
/// that both held. Thread: haptic; nonblocking.
class SharedSubject {
 public:
  SharedSubject(const Grasp& grasp, const SubjectSettings& settings, double period);

  /// The brain's own devices know its forces; the object it sees.
  void see(const ObjectState& objects, const Tick& tick) noexcept;
  FingerInput read(int digit, const Tick& tick) noexcept;
  void write(int digit, const Vec3& f_H_W, const Tick& tick) noexcept;

  const subject::Brain& brain() const noexcept { return brain_; }
  const SubjectSettings& settings() const noexcept { return settings_; }
  /// A device takes a digit; false when another has it already.
  bool take(int digit) noexcept { return !std::exchange(taken_[static_cast<std::size_t>(digit)], true); }

 private:
  void advance(const Tick& tick) noexcept;
  void live(double period) noexcept;
  Vec3 inwardOf(int digit) const noexcept { return digit == 0 ? grasp_.inward_W : Vec3(-grasp_.inward_W); }

  const Grasp grasp_;
  const SubjectSettings settings_;
  subject::Hand hand_;
  subject::Brain brain_;
  subject::Senses senses_;
  Tick at_;
  std::array<bool, subject::kDigits> taken_{};
  double seen_height_ = 0, staying_behind_ = 0;  // object above fingers [m], its rate against them [m/s]
  double seen_before_ = 0;
};

}  // namespace presa
