#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "framework/bus/wall_link.h"

namespace presa::walls {

/// One wall's part of the frame lock: which frame to draw, and what to tell the leader. Follows one leader until it
/// falls silent. Times are those of CLOCK_MONOTONIC. Thread: one.
class WallFollower {
 public:
  static constexpr std::int64_t kSilence = 1'000'000'000;  ///< a leader that says nothing for so long is lost [ns]
  static constexpr std::int64_t kGreeting = 50'000'000;    ///< between repetitions of the last answer [ns]

  /// `sender`: random id of this process. `rest`: the head that it shows before the first frame.
  WallFollower(std::uint64_t sender, const std::string& wall, const Pose& rest);

  void hear(const bus::WallFrame& frame, std::int64_t now_ns);
  /// The announced frame that is not drawn yet; else null.
  const bus::WallFrame* due() const noexcept { return frame_.number > said_.number ? &frame_ : nullptr; }
  /// The frame is on the wall: the answer, which the caller sends.
  const bus::WallDrawn& drawn(std::uint64_t state, std::int64_t now_ns);
  /// The last answer again, or a greeting; null between them.
  const bus::WallDrawn* again(std::int64_t now_ns);

  /// Whether a leader was heard, and whether it fell silent since.
  bool led() const noexcept { return frame_.leader != 0; }
  bool leaderLost(std::int64_t now_ns) const noexcept { return led() && now_ns - heard_ns_ > kSilence; }
  /// The last announced frame.
  const bus::WallFrame& frame() const noexcept { return frame_; }

 private:
  bus::WallFrame frame_;
  bus::WallDrawn said_;
  std::int64_t heard_ns_ = 0, said_ns_ = 0;
};

}  // namespace presa::walls
