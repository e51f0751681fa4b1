#pragma once
#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/convex_pairs.h"
#include "framework/haptics/tool_renderer.h"
#include "modules/xfca/god_object.h"

namespace presa {

/// A place at which a body pushes the tool.
struct Place {
  std::int32_t body = kNoBody;  ///< index into Scene::bodies
  Vec3 p_W = Vec3::Zero();      ///< [m]
  Vec3 nhat_W = Vec3::UnitZ();  ///< unit, body into tool
  double depth = 0;             ///< its part of the push, along nhat_W [m]
};

/// Where a push acts: surfaces that lie on each other share it as an elastic layer on their corners would, so that its
/// centre moves without a jump as the tool leans. Thread: haptic; nonblocking except for construction.
class Places {
 public:
  static constexpr std::size_t kMaxOfPart = 16,  ///< places of a part of the push; more are left out
      kMax = 3 * kMaxOfPart;                     ///< places of a push

  Places(ConvexPairs& pairs, const std::vector<ConvexSolid>& bodies) : pairs_(pairs), bodies_(bodies), all_(kMax) {}

  /// For the pairs as at the last separate().
  void find(const GodObject::Push& push) noexcept;
  const BoundedList<Place>& all() const noexcept { return all_; }  ///< of the last push

 private:
  void findAlong(const GodObject::Push::Part& part) noexcept;

  ConvexPairs& pairs_;
  const std::vector<ConvexSolid>& bodies_;
  BoundedList<Place> all_;
};

}  // namespace presa
