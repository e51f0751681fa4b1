#pragma once
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa {

/// Name of the port that carries a FrameState.
inline constexpr const char* kFramesPort = "frame_state";

/// What happens to a frame of the rig (FrameNow::doing): what its user does, and what its tool does.
enum FrameDoing : std::uint32_t {
  kFrameWalks = 1u << 0,     ///< the frame moves
  kFrameClutched = 1u << 1,  ///< it slides back under the hand
  kFrameZooms = 1u << 2,     ///< its scale changes
  kFrameWaits = 1u << 3,     ///< a wish waits until no finger in it feels a force
  kFrameLost = 1u << 4,      ///< it stands still: the tool that carries it is not tracked
  kFrameReturns = 1u << 5,   ///< that tool is tracked again, and the frame is on its way back to it
};

/// One frame of the rig at one moment.
struct FrameNow {
  Pose X_WF;                   ///< pose now
  double zoom = 1;             ///< metres of the world for one of the frame
  std::uint32_t doing = 0;     ///< FrameDoing bits
  std::uint32_t uses = 0;      ///< walks, clutches and zooms begun so far
  std::uint32_t refusals = 0;  ///< of them: had to wait, or met a body and were taken back
  std::uint32_t losses = 0;    ///< how often the tool that carries it was lost so far
};

/// The frames of the rig, in its order. Only in runs whose rig has frames.
/// Sized at load. Written by: haptic thread (frame_watch).
struct FrameState {
  double time = 0;               ///< [s]
  std::vector<FrameNow> frames;  ///< in the order of Rig::frames

  FrameState() = default;                                    ///< of no frame
  explicit FrameState(std::size_t count) : frames(count) {}  ///< frames of the rig
  /// Heap memory that it owns [bytes] (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return frames.capacity() * sizeof(FrameNow); }
};

}  // namespace presa
