#pragma once
#include <cstdint>
#include <optional>

#include "framework/device/frame_motion.h"
#include "framework/device/pointer_state.h"
#include "framework/scene/frame_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// The part of a frame's motion that its user gives it (Frame::driven): a point p of the frame goes to
///     X_FU (c + s p)
/// X_FU walks and flies, the offset c follows the clutch, s is the zoom, about the hand, which stays where it is.
///
/// Nothing of it moves while a finger in the frame feels a force. A step is known to be free one tick later: if a force
/// answers it, this force is withheld from the hands (changed()), the step is taken back, and the frame rests for
/// kPause. So X_FU, c and s are constant under every force that a hand gets, and the motion of a frame does no work on
/// it.
/// Thread: haptic; nonblocking.
class FrameDrive {
 public:
  static constexpr double kStart = 0.2;  ///< from rest to full speed [s]
  static constexpr double kPause = 0.2;  ///< rest after a step that met a body [s]

  explicit FrameDrive(const Frame& frame);  ///< at rest, where the rig has it

  /// Middle of the fingers in the frame, as their devices measure them.
  struct Hand {
    Vec3 p = Vec3::Zero(),  ///< position in the frame [m]
        v = Vec3::Zero();   ///< velocity in the frame [m/s]
  };
  /// What the last wrenches said.
  struct Touch {
    bool written = true;  ///< every finger got one since the last step
    bool felt = false;    ///< one of them was not zero, or a finger has no sample
  };
  /// Once a tick, before the samples go to the world. `wish`: of window and buttons; `hand`: none in an empty frame.
  void step(const FrameWish& wish, const std::optional<Hand>& hand, Touch touch, double period) noexcept;

  /// Relative to the frame without a user.
  FrameMotion motion() const noexcept;
  /// The last step has not been answered yet: a force now is due to it.
  bool changed() const noexcept { return changed_; }
  /// Without the pose.
  const FrameNow& now() const noexcept { return now_; }

 private:
  struct Place {
    Pose X_FU;
    Vec3 c = Vec3::Zero();
    double s = 1;
  };
  struct Rates {
    Vec3 v = Vec3::Zero(), c = Vec3::Zero();  ///< in F; of the offset
    double turn = 0, s = 0;
  };
  std::uint32_t asked(const FrameWish& wish) const noexcept;
  void rest() noexcept;
  void count(std::uint32_t asked, bool refused) noexcept;
  void walk(const FrameWish& wish, double period) noexcept;
  void slide(const FrameWish& wish, const std::optional<Hand>& hand, double period) noexcept;

  Frame::Moves moves_;
  double speed_, turn_;
  Vec3 drift_;
  bool has_clutch_;
  std::optional<Frame::Zoom> zoom_;
  Place place_, free_;  // now, and the last one known to be free
  Rates rates_;
  Vec3 walking_ = Vec3::Zero();  // [m/s], in the axes of the user
  double turning_ = 0;           // [rad/s]
  std::optional<Vec3> anchor_;   // where the clutch holds the hand, in U
  double pause_ = 0;             // left [s]
  bool changed_ = false;
  std::uint32_t asked_ = 0, refused_ = 0;  // FrameDoing bits of the wishes, and of those that had to wait
  FrameNow now_;
};

}  // namespace presa
