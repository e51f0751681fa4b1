#pragma once
#include <array>
#include <cstdint>

#include "framework/state/contact_patch.h"
#include "modules/haptics_proxy/convex_piece.h"

namespace presa {

/// What surrounds one fingertip in this tick, in the working frame A. The sources are set once a tick; the pieces that
/// count are picked anew around wherever the fingertip is, so that a fine mesh costs what is touched, not what is near.
/// Fixed memory. Thread: haptic; nonblocking.
class Surroundings {
 public:
  static constexpr int kMaxPrimitives = 64;
  static constexpr int kCapacity = kMaxPatchTriangles + kMaxPrimitives;
  /// Sphere within which a patch is complete: the fingertip may not leave it.
  struct Cover {
    Vec3 center = Vec3::Zero();
    double radius = 0;
  };

  void clear() noexcept {
    primitive_count_ = source_count_ = count_ = 0;
    reach_ = -1;
  }
  /// A piece that is always looked at.
  void add(const ConvexPiece& piece) noexcept;
  /// Triangles of one body's patch, in the body's coordinates; X_AB null when A is the body itself. They must outlive the tick.
  void addTriangles(const PatchTriangle* triangles, int count, std::int32_t body, const Pose* X_AB,
                    const Cover& cover) noexcept;
  /// Picks every piece within r + margin of x, or keeps an earlier pick that has them all.
  void lookAround(const Vec3& x, double r, double margin) noexcept;

  int count() const noexcept { return count_; }
  const ConvexPiece& piece(int i) const noexcept { return pieces_[static_cast<std::size_t>(i)]; }
  /// Lower bound of the distance from piece i to x; negative: not known.
  double distanceBound(int i, const Vec3& x) const noexcept {
    return distance_[static_cast<std::size_t>(i)] - (x - center_).norm();
  }
  int coverCount() const noexcept { return source_count_; }
  const Cover& cover(int i) const noexcept { return sources_[static_cast<std::size_t>(i)].cover; }
  /// Pieces that found no room, since start.
  std::uint32_t overflow() const noexcept { return overflow_; }

 private:
  struct Source {
    const PatchTriangle* triangles = nullptr;
    int count = 0;
    std::int32_t body = kNoBody;
    bool own = true;
    Pose X_AB;
    Cover cover;
  };
  std::array<ConvexPiece, kMaxPrimitives> primitives_;
  std::array<Source, kMaxNearBodies> sources_;
  std::array<ConvexPiece, kCapacity> pieces_;
  std::array<double, kCapacity> distance_;
  int primitive_count_ = 0, source_count_ = 0, count_ = 0;
  Vec3 center_ = Vec3::Zero();  // of the last pick
  double reach_ = -1;           // of the last pick; negative: none
  std::uint32_t overflow_ = 0;
};

/// Result of moving a proxy towards its goal.
struct ProxyMove {
  Vec3 x = Vec3::Zero();            ///< where the fingertip's centre ends
  Vec3 first_touch = Vec3::Zero();  ///< where it first met a surface (x itself when it never did)
  bool touching = false;            ///< a surface keeps it from the goal
  bool covered = true;              ///< false: it waits at the border of what the patches cover
  std::int32_t body = kNoBody;      ///< the body that holds it back most
};

/// Moves a sphere of radius r from x towards g without passing through any piece, and returns the local
/// minimum of |x - g|: the god-object with finite radius [Zilles1995], [Ruspini1997]. Exact: each leg goes to the
/// solution of the active-set programme, stopped by the first new contact (swept, so nothing is jumped over).
/// Tolerances are relative to r. Thread: haptic; nonblocking.
ProxyMove moveProxy(const Vec3& x, const Vec3& g, double r, Surroundings& surroundings) noexcept;

/// True when a fingertip at x overlaps no piece.
bool isClear(const Vec3& x, double r, Surroundings& surroundings) noexcept;

/// Two-state friction cone of the PERCRO paper (section 3.3, figure 10), applied to the proxy.
struct FrictionCone {
  double mu_static = 0;
  double mu_dynamic = 0;
};

/// What a fingertip carries from tick to tick, in the working frame A.
struct FingertipState {
  Vec3 x = Vec3::Zero();    ///< proxy: where friction holds the fingertip
  Vec3 god = Vec3::Zero();  ///< where it would be without friction; x itself in free space
  bool touching = false;
  bool slipping = false;
};

/// One fingertip at the surface, in the working frame A.
struct ProxyContact {
  FingertipState state;
  Vec3 nhat = Vec3::UnitZ();    ///< direction of the frictionless force, body into finger
  double depth = 0;             ///< (x - g) . nhat
  Vec3 stretch = Vec3::Zero();  ///< x - g without its normal part
  bool covered = true;
  std::int32_t body = kNoBody;
};

/// One tick towards the HIP g. `cone_of(body)` gives the friction of the touched body.
template <class ConeOf>
ProxyContact stepProxy(const FingertipState& last, const Vec3& g, double r, Surroundings& surroundings,
                       const ConeOf& cone_of) noexcept;

}  // namespace presa

#include "modules/haptics_proxy/god_object_friction.h"
