#pragma once
#include <array>
#include <cstdint>

#include "framework/state/limits.h"
#include "modules/haptics_proxy/convex_piece.h"

namespace presa {

/// What surrounds one fingertip in this tick, in the working frame A. Fixed memory.
struct Surroundings {
  static constexpr int kCapacity = kMaxPatchTriangles + 64;
  std::array<ConvexPiece, kCapacity> pieces;
  int count = 0;
  std::uint32_t overflow = 0;        ///< pieces that found no room, since start

  /// Spheres within which the patches are complete: the fingertip may not leave them.
  struct Cover {
    Vec3 center = Vec3::Zero();
    double radius = 0;
  };
  std::array<Cover, kMaxNearBodies> covers;
  int cover_count = 0;

  void clear() noexcept { count = cover_count = 0; }
  void add(const ConvexPiece& piece) noexcept {
    if (count < kCapacity) {
      pieces[static_cast<std::size_t>(count++)] = piece;
    } else {
      ++overflow;
    }
  }
};

/// Result of moving a proxy towards its goal.
struct ProxyMove {
  Vec3 x = Vec3::Zero();             ///< where the fingertip's centre ends
  Vec3 first_touch = Vec3::Zero();   ///< where it first met a surface (x itself when it never did)
  bool touching = false;             ///< a surface keeps it from the goal
  bool covered = true;               ///< false: it waits at the border of what the patches cover
  std::int32_t body = kNoBody;       ///< the body that holds it back most
};

/// Moves a sphere of radius r from x towards g without passing through any piece, and returns the local
/// minimum of |x - g|: the god-object with finite radius [Zilles1995], [Ruspini1997]. Exact: each leg goes to the
/// solution of the active-set programme, stopped by the first new contact (swept, so nothing is jumped over).
/// Tolerances are relative to r. Thread: haptic; nonblocking.
ProxyMove moveProxy(const Vec3& x, const Vec3& g, double r, const Surroundings& surroundings) noexcept;

/// True when a fingertip at x overlaps no piece.
bool isClear(const Vec3& x, double r, const Surroundings& surroundings) noexcept;

/// Two-state friction cone of the PERCRO paper (section 3.3, figure 10), applied to the proxy.
struct FrictionCone {
  double mu_static = 0;
  double mu_dynamic = 0;
};

/// One fingertip at the surface, in the working frame A.
struct ProxyContact {
  Vec3 x = Vec3::Zero();             ///< proxy
  Vec3 nhat = Vec3::UnitZ();         ///< direction of the frictionless force, body into finger
  double depth = 0;                  ///< (x - g) . nhat
  Vec3 stretch = Vec3::Zero();       ///< x - g without its normal part
  bool touching = false;
  bool slipping = false;
  bool covered = true;
  std::int32_t body = kNoBody;
};

/// `coneOf(body)` gives the friction of the touched body. `was_touching`, `was_slipping`: the last tick's state.
template <class ConeOf>
ProxyContact stepProxy(const Vec3& x, const Vec3& g, double r, bool was_touching, bool was_slipping,
                       const Surroundings& surroundings, const ConeOf& coneOf) noexcept;

}  // namespace presa

#include "modules/haptics_proxy/god_object_friction.h"
