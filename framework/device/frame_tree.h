#pragma once
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/scene/scene.h"

namespace presa {

/// Where a frame is in the world, and how it moves.
struct FrameMotion {
  Pose X_WF;
  Vec3 v_WF = Vec3::Zero();  ///< of its origin [m/s]
  Vec3 w_WF = Vec3::Zero();  ///< [rad/s]
};

/// The frames of a rig (figure 8 of the PERCRO paper: user, head, device): fixed, moved through keys, or carried by the
/// tool of a role. A frame on a tool sees the newest sample of that tool.
/// Thread: haptic, except for construction; nonblocking.
class FrameTree {
 public:
  static constexpr int kWorld = -1;

  /// `roles`: those of the scene. The rig is checked.
  FrameTree(const Rig& rig, const std::vector<DeviceRole>& roles);

  /// Index of the frame or tool with that name; kWorld for "world" and for a role that the scene does not have.
  int find(const std::string& name) const;
  /// Whether some frame or device stands on the tool of this role.
  bool carries(std::size_t role) const noexcept { return carries_[role] != 0; }

  /// Motion of a frame at `time` [s]. The index is that of find().
  FrameMotion at(int frame, double time) const noexcept;
  void setTool(std::size_t role, const FrameMotion& tool) noexcept { tools_[role] = tool; }

 private:
  struct Node {
    Frame frame;
    int parent = kWorld;
  };
  std::vector<std::string> roles_;
  std::vector<Node> nodes_;         // find() gives them indices from roles_.size() on
  std::vector<FrameMotion> tools_;  // by role
  std::vector<char> carries_;       // by role
};

}  // namespace presa
