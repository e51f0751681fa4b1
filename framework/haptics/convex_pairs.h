#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/convex_parts.h"
#include "framework/haptics/touchables.h"

namespace presa {

/// A convex part of a tool near one of a body, and a plane between them.
struct NearParts {
  std::uint32_t tool_part = 0;  ///< index into the tool's parts
  std::uint32_t solid = 0;      ///< index into the bodies
  std::uint32_t part = 0;       ///< index into the body's parts
  Vec3 nhat_W = Vec3::UnitZ();  ///< unit, from the body into the tool
  double gap = 0;  ///< along nhat_W; negative: overlap, along the last tick's plane turned towards less [m]
  Vec3 on_body_W = Vec3::Zero(),  ///< nearest points; where they overlap, the farthest along nhat_W [m]
      on_tool_W = Vec3::Zero();   ///< the same of the tool
};

/// The convex parts of one tool against those of all bodies. Since the parts are convex, the tool may move anywhere on
/// its own side of a pair's plane, at any speed. Memory is fixed. Thread: haptic; nonblocking except for construction.
class ConvexPairs {
 public:
  static constexpr std::size_t kMaxNear = 256;  ///< pairs in a tick

  /// Both must outlive it.
  ConvexPairs(const ConvexSolid& tool, const std::vector<ConvexSolid>& bodies);

  /// Poses of the bodies in this tick.
  void place(const Touchables& touchables) noexcept;
  /// Lists the pairs that come within `reach` [m] of each other as far as the spheres around the parts say, for a tool at
  /// X_WT. False: there are more than kMaxNear; the nearest ones are listed.
  bool gather(const Pose& X_WT, double reach) noexcept;
  /// Distance of the spheres around the nearest parts: a lower bound of the tool's clearance, for a tool at X_WT [m].
  double clearance(const Pose& X_WT) const noexcept;
  /// Finds the planes of the pairs listed, for a tool at X_WT. Of those farther apart than `beyond` [m] only a plane and a
  /// lower bound of the gap.
  void separate(const Pose& X_WT, double beyond) noexcept;
  /// The tool moves on by `step` without turning: finds the planes of pairs whose gap is then up to `within` [m] anew, and
  /// keeps those of the others, which it cannot have crossed.
  void follow(const Vec3& step, double within) noexcept;
  /// The same as separate() of one pair, listed or a copy; touch() is for those of near() only.
  void separate(NearParts& pair, const Pose& X_WT, double beyond) noexcept;
  const BoundedList<NearParts>& near() const noexcept { return near_; }  ///< at the last separate()
  /// The points, up to eight, at which a pair comes within `margin` [m] along its plane, as at the last separate().
  void touch(const NearParts& pair, double margin, Manifold& out) noexcept;
  std::size_t pairCount() const noexcept { return memories_.size(); }  ///< of all parts of tool and bodies
  /// Number of a pair, below pairCount().
  std::size_t indexOf(const NearParts& pair) const noexcept {
    return (first_part_[pair.solid] + pair.part) * tool_.parts.size() + pair.tool_part;
  }
  /// The tool has been elsewhere: planes of earlier ticks mean nothing.
  void forget() noexcept { ++ticks_; }

 private:
  struct Memory {
    DistanceMemory distance;
    std::uint64_t tick = 0;             // of the last search
    std::array<CylinderTurn, 2> turns;  // of body and tool
  };
  void list(const NearParts& pair) noexcept;
  Memory& memoryOf(const NearParts& pair) noexcept { return memories_[indexOf(pair)]; }
  /// The hull of a part as the contact of two hulls wants it, found once for each pose.
  struct InWorld {
    Hull hull;
    std::uint64_t pose = 0;  // number of the pose, below
  };
  PlacedSupport placedBody(const NearParts& pair) const noexcept;
  PlacedSupport placedTool(const NearParts& pair) const noexcept;

  const ConvexSolid& tool_;
  const std::vector<ConvexSolid>& bodies_;
  std::vector<Pose> X_WB_;                        // by solid
  std::vector<std::size_t> first_part_;           // by solid: index of its first part among all
  std::vector<Vec3> centres_W_;                   // by part of all bodies
  std::vector<Memory> memories_;                  // by part of all bodies, and by part of the tool
  std::vector<InWorld> bodies_in_W_, tool_in_W_;  // by part, from the tool's origin
  std::uint64_t ticks_ = 1;                       // number of calls of place()
  std::uint64_t poses_ = 0;                       // number of poses of the tool so far
  Pose X_WT_;                                     // at the last separate()
  double separated_ = -1;  // range of the planes of near_ at X_WT_ [m]; below zero: not found yet
  BoundedList<NearParts> near_;
  FacingHulls facing_;
};

}  // namespace presa
