#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "apps/presa/remote/head_tracker.h"
#include "framework/bus/remote_picture.h"
#include "framework/walls/canvas.h"
#include "framework/walls/wall_follower.h"
#include "framework/walls/wall_leader.h"

namespace presa {

/// Options of `presa view --walls`.
struct CaveSettings {
  std::string walls;  ///< file; empty: no CAVE
  std::string wall;   ///< name of the wall that this process draws; empty: none
  std::string head;   ///< rig of the head; this process then leads the others
  walls::Stereo stereo = walls::Stereo::kMono;
  double max_rate = 60;  ///< of frames [Hz]
};

/// This process's part in a CAVE: a wall, the head and the lead, or both. Thread: main.
class Cave {
 public:
  /// Throws InputError: the walls or the head cannot be read.
  Cave(const CaveSettings& settings, const BusSettings& bus);

  /// What the view draws on; null: this process has no wall.
  walls::Canvas* canvas() { return wall_ != nullptr ? &canvas_ : nullptr; }
  /// Decides what the next picture shows; false: there is nothing new to draw. Call after picture.advance(). Throws
  /// InputError E767 another process leads already, before the first frame that this one announces.
  bool next(bus::RemotePicture& picture, std::int64_t now_ns);
  /// Whether the next picture shows the states of the last one, as the leader is lost.
  bool frozen() const noexcept { return frozen_; }
  /// That picture is on the wall; `state`: hash of the drawn poses.
  void drawn(std::uint64_t state, std::int64_t now_ns);

  /// Head, leader and walls in a few words, for the terminal.
  std::string line(std::int64_t now_ns) const;
  /// What happened, after the last picture.
  std::string summary() const;

 private:
  void hear(std::int64_t now_ns);
  void hearOtherLeader(const bus::WallFrame& frame, std::int64_t now_ns);
  void lead(const bus::RemotePicture& picture, std::int64_t now_ns);
  bool follow(bus::RemotePicture& picture, std::int64_t now_ns);
  void look(const Pose& X_KHead);
  double frameRate() const;
  std::int64_t period() const { return static_cast<std::int64_t>(1e9 / settings_.max_rate); }

  const CaveSettings settings_;
  const walls::Walls walls_;
  const walls::Wall* const wall_;  // null: none
  walls::Canvas canvas_;
  bool behind_wall_ = false;
  bool frozen_ = false;
  bool drew_ = false;       // some picture
  bool shows_due_ = false;  // the next picture is an announced frame
  const std::unique_ptr<bus::WallLink> link_;
  const std::uint64_t id_;
  std::unique_ptr<HeadTracker> head_;            // of the leader
  std::optional<walls::WallLeader> leader_;      // of the leader
  std::optional<walls::WallFollower> follower_;  // with a wall
  std::int64_t begin_ns_ = 0, announced_ns_ = 0, waits_since_ns_ = 0, other_leader_ns_ = 0;
  std::int64_t first_ns_ = 0, last_ns_ = 0;  // of the frames
  std::uint64_t frames_ = 0, late_ = 0;
};

/// What tells apart the states that walls draw.
std::uint64_t drawnState(const ObjectState& objects);

}  // namespace presa
