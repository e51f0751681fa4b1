#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"
#include "framework/scene/scene.h"

namespace presa {

/// Two bodies that met: the dynamics stopped their approach.
struct BodyHit {
  double time = 0;                 ///< of the impact [s]; up to a dynamics period after the state's own time
  std::int32_t A = kNoBody,        ///< indices into Scene::bodies; A may be fixed
      B = kNoBody;                 ///< moves
  Vec3 p_W = Vec3::Zero();         ///< contact point [m]
  Vec3 nhat_AB_W = Vec3::UnitZ();  ///< contact normal, from A into B
  double speed = 0;                ///< at which the two approached each other along the normal [m/s], > 0

  /// The body that `body` met; kNoBody: the hit is none of its.
  std::int32_t otherThan(std::int32_t body) const noexcept { return body == A ? B : body == B ? A : kNoBody; }
};

/// The newest hits between bodies. A reader keeps the number up to which it has read, so that it misses none that is
/// still there, however many states it has missed. Written by: dynamics thread, in scenes with a listener.
class BodyHits {
 public:
  static constexpr double kMinSpeed = 0.01;  ///< slower contacts are touches, not hits [m/s]
  static constexpr double kSamePair = 0.03;  ///< time in which the same pair is heard again only if faster [s]
  /// Hits that are kept for so many bodies: more than they have in a few steps of the dynamics.
  static std::size_t roomFor(std::size_t bodies) noexcept { return std::min<std::size_t>(64 + 8 * bodies, 1024); }

  BodyHits() = default;  ///< room for none: what add() is given is left out
  /// Room for the newest `room` hits.
  explicit BodyHits(std::size_t room) : ring_(room) {}

  /// Hits since the start, kept or not.
  std::uint64_t count() const noexcept { return count_; }
  /// Adds a hit, unless it goes on with one of the same pair (kSamePair).
  void add(const BodyHit& hit) noexcept;
  /// Calls `hear` with the hits from number `next` on, oldest first, up to the first that it refuses (false); moves
  /// `next` behind those it took. Returns how many were overwritten before they were read.
  template <class Hear>
  std::uint64_t read(std::uint64_t& next, Hear hear) const {
    const std::uint64_t oldest = count_ > ring_.size() ? count_ - ring_.size() : 0;
    const std::uint64_t lost = next < oldest ? oldest - next : 0;
    for (next += lost; next < count_; ++next) {
      if (!hear(ring_[next % ring_.size()])) break;
    }
    return lost;
  }

  std::size_t room() const noexcept { return ring_.size(); }  ///< hits that are kept
  /// Memory outside the object itself (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return ring_.capacity() * sizeof(BodyHit); }

 private:
  std::vector<BodyHit> ring_;  // hit number n is at n % size
  std::uint64_t count_ = 0;
};

/// Whether an element of the scene needs the hits between its bodies: needs="hits" in the manifest of its plug-in.
/// Only then does the dynamics look for them. Thread: any.
bool needsBodyHits(const Scene& scene);

/// The dynamics writes it.
inline constexpr const char* kBodyHitsPort = "body_hits";

}  // namespace presa
