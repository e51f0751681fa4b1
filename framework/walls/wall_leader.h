#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/bus/wall_link.h"

namespace presa::walls {

/// Keeps walls in step: announces a frame only when every wall has drawn the one before, so that no wall is ever more
/// than one frame ahead of another. A wall that says nothing for kPatience is left behind until it speaks again; one
/// that speaks but does not draw the frame for so long, until it draws one. Times are those of CLOCK_MONOTONIC.
/// Thread: one.
class WallLeader {
 public:
  static constexpr std::int64_t kPatience = 1'000'000'000;  ///< [ns]
  static constexpr std::int64_t kRepeat = 50'000'000;       ///< an unanswered frame is announced again [ns]

  static constexpr std::size_t kMost = 64;  ///< processes; more are not waited for

  explicit WallLeader(std::uint64_t id) { frame_.leader = id; }

  /// False: the message is damaged or forged, or there are too many processes; it changed nothing.
  bool hear(const bus::WallDrawn& drawn, std::int64_t now_ns);
  /// Whether the next frame may be announced.
  bool ready(std::int64_t now_ns);
  /// The next frame; the caller sends it. In place of an unsound head (sound.h) the last one is announced.
  const bus::WallFrame& next(std::uint64_t run, double time, const Pose& X_KHead, bool tracked, std::int64_t now_ns);
  /// The last frame again, when walls have not answered for kRepeat; else null.
  const bus::WallFrame* again(std::int64_t now_ns);

  std::uint64_t frames() const noexcept { return frame_.number; }
  /// Names of the walls that take part.
  std::vector<std::string> present() const;
  /// How often a wall was left behind, and how many frames two walls drew from different states.
  std::uint64_t leftBehind() const noexcept { return left_behind_; }
  std::uint64_t differing() const noexcept { return differing_; }

 private:
  struct Member {
    std::string wall;
    std::uint64_t number = 0;
    std::int64_t heard_ns = 0, since_ns = 0;  // last word; since when it takes part
    bool behind = true;                       // not waited for, as before its first word
    bool idle = false;                        // behind although it speaks
  };
  bool makeRoom();
  void compare(std::uint64_t state);

  bus::WallFrame frame_;
  std::map<std::uint64_t, Member> members_;  // by sender
  std::uint64_t state_ = 0, left_behind_ = 0, differing_ = 0;
  bool state_known_ = false, frame_differs_ = false;
  std::int64_t announced_ns_ = 0, sent_ns_ = 0;  // of the frame: first and last time
};

}  // namespace presa::walls
