#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/schedule/tick.h"
#include "framework/core/state/device_state.h"
#include "framework/device/frame_drive.h"
#include "framework/device/frame_motion.h"
#include "framework/device/sample_check.h"
#include "framework/device/tool_watch.h"
#include "framework/scene/scene.h"

namespace presa {

/// The frames of a rig (figure 8 of the PERCRO paper: user, head, device): fixed, moved through keys, moved by their
/// user (FrameDrive), or carried by the tool of a role. A frame on a tool follows the newest sample of that tool
/// (ToolWatch).
/// Thread: haptic, except for construction; nonblocking.
class FrameTree {
 public:
  static constexpr int kWorld = -1;  ///< index of W

  /// `roles`: those of the scene. The rig is checked.
  FrameTree(const Rig& rig, const std::vector<DeviceRole>& roles);

  /// Index of the frame or tool with that name; kWorld for "world" and for a role that the scene does not have.
  int find(const std::string& name) const;
  /// Whether some frame or device stands on the tool of this role.
  bool carries(std::size_t role) const noexcept { return carries_[role] != 0; }
  /// Whether the device of this role stands in a frame that a user moves.
  bool drives(std::size_t role) const noexcept { return !seats_[role].empty(); }

  /// Motion of a frame at `time` [s]. The index is that of find().
  FrameMotion at(int frame, double time) const noexcept;
  /// The newest sample of a tool that carries something; `valid`: it is one.
  void track(std::size_t role, const FrameMotion& tool, bool valid, double time) noexcept {
    tools_[role].update(tool, valid, time);
  }
  /// For pictures: there the tool is.
  void setTool(std::size_t role, const FrameMotion& tool) noexcept { tools_[role].put(tool); }
  /// Whether it is known where a frame is: not before the first sample of the tool that carries it.
  bool known(int frame) const noexcept;

  /// The sample of a driven role's device, in its own frame. The first one of a tick moves the frames that it is in.
  void sampled(std::size_t role, const FingerInput& sample, const Tick& tick) noexcept;
  /// The wrench on a driven role's tool, zero or not. True if it answers a step of a frame: the hand must not get it.
  bool withholds(std::size_t role, bool felt) noexcept;
  /// The force on this driven role says nothing about what it touches: the output stage stops it, or it touches a body
  /// and the stage withholds its force. Its frames rest. Holds until the next call.
  void doubt(std::size_t role, bool doubted) noexcept;
  /// Clears what a driven role's samples were rejected for.
  void rearm(std::size_t role) noexcept;
  /// What the keys of the window say.
  void wish(const FrameWish& wish) noexcept { wish_ = wish; }

  /// The frames of the rig now, in its order; `state` is sized for them.
  void tell(double time, FrameState& state) const noexcept;
  std::size_t frames() const noexcept { return nodes_.size(); }  ///< number of frames of the rig
  std::size_t roles() const noexcept { return roles_.size(); }   ///< number of roles of the scene

 private:
  /// A device in a driven frame.
  struct Seat {
    std::size_t role = 0;
    int frame = kWorld;  // in which it stands
    FrameDrive::Hand hand;
    SampleCheck check;  // no impossible sample moves a frame
    std::uint32_t buttons = 0;
    bool seen = false, valid = false;  // a sample has come; the last one was good
    bool written = false, felt = false, doubted = false;
  };
  struct Drive {
    explicit Drive(const Frame& frame) : motion(frame) {}
    FrameDrive motion;
    std::vector<Seat> seats;
    std::uint64_t next_tick = 0;  // ticks before it have been stepped
  };
  struct Node {
    Frame frame;
    int parent = kWorld;
    std::optional<Drive> drive;
  };
  struct SeatOf {
    std::size_t node, seat;
  };
  void seat(std::size_t role, int frame);
  FrameMotion inParent(const Node& node, double time) const noexcept;
  std::optional<FrameMotion> within(int frame, std::size_t node, double time) const noexcept;
  std::optional<FrameDrive::Hand> middle(std::size_t node, double time) const noexcept;
  FrameWish wishFor(const Node& node) const noexcept;
  void step(std::size_t node, const Tick& tick) noexcept;

  std::vector<std::string> roles_;
  std::vector<Node> nodes_;                 // find() gives them indices from roles_.size() on
  std::vector<ToolWatch> tools_;            // by role
  std::vector<char> carries_;               // by role
  std::vector<int> stands_;                 // by role: frame of its device
  std::vector<std::vector<SeatOf>> seats_;  // by role
  FrameWish wish_;
};

/// Smallest and largest scale, to the world, of the frames that the device of a role stands in; each at most and at
/// least 1.
struct ZoomRange {
  double min = 1,  ///< at most 1 [-]
      max = 1;     ///< at least 1 [-]
};
/// 1 to 1 for a role that stands in no frame with a zoom, or is not in the rig.
ZoomRange zoomRange(const Rig& rig, const std::string& role);

}  // namespace presa
