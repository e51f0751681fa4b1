#pragma once
#include <array>
#include <cstdint>

#include "framework/haptics/surroundings.h"

namespace presa {

/// What holds a proxy: the half-spaces of the active set, at most three. From the goal to the proxy is the sum of weight * nhat.
struct ActiveSet {
  struct Member {
    PieceRef piece;
    std::int32_t body;
    Vec3 nhat;
    double weight;  ///< multiplier [m], >= 0
  };
  std::array<Member, 3> member;
  int count = 0;
};

/// Result of moving a proxy towards its goal.
struct ProxyMove {
  Vec3 x = Vec3::Zero();            ///< where the fingertip's centre ends
  Vec3 first_touch = Vec3::Zero();  ///< where it first met a surface (x itself when it never did)
  bool touching = false;            ///< a surface keeps it from the goal
  std::int32_t body = kNoBody;      ///< the body that holds it back most
  ActiveSet active;
};

/// Moves a sphere of radius r from x towards g without passing through any piece, and returns the local
/// minimum of |x - g|: the god-object with finite radius [Zilles1995], [Ruspini1997]. Exact: each leg goes to the
/// solution of the active-set programme, stopped by the first new contact (swept, so nothing is jumped over).
/// Whatever the constraints say, a leg keeps the centre at half its distance from each piece: it cannot cross a surface.
/// Tolerances are relative to r, and never below the rounding of the coordinates. Thread: haptic; nonblocking.
ProxyMove moveProxy(const Vec3& x, const Vec3& g, double r, Surroundings& surroundings) noexcept;

/// True when a fingertip at x touches a piece and overlaps none.
bool isSupported(const Vec3& x, double r, Surroundings& surroundings) noexcept;

/// What a fingertip carries from tick to tick, in the working frame A.
struct FingertipState {
  Vec3 x = Vec3::Zero();    ///< proxy: where friction holds the fingertip
  Vec3 god = Vec3::Zero();  ///< where it would be without friction; x itself in free space
  bool touching = false;
  bool slipping = false;
  Vec3 hold = Vec3::Zero();  ///< what friction pulls the HIP back to: below the surface, x is the proxy of it
};

/// One fingertip at the surface, in the working frame A.
struct ProxyContact {
  FingertipState state;
  Vec3 x = Vec3::Zero();            ///< proxy that is rendered: state.x, unless an effect moves it
  Vec3 first_touch = Vec3::Zero();  ///< where the motion of this tick first met a surface
  Vec3 nhat = Vec3::UnitZ();        ///< direction of the frictionless force, body into finger
  double depth = 0;                 ///< (x - g) . nhat
  Vec3 stretch = Vec3::Zero();      ///< x - g without its normal part
  std::int32_t body = kNoBody;
  ActiveSet active;   ///< of the frictionless point
  bool swept = true;  ///< the proxy moves along paths; false: a renderer without memory, which may jump
};

/// One tick towards the HIP g without friction: the proxy slides freely.
ProxyContact slideProxy(const FingertipState& last, const Vec3& g, double r, Surroundings& surroundings) noexcept;

/// Coefficients of the two-state friction cone of the PERCRO paper (section 3.3, figure 10).
struct FrictionCone {
  double mu_static = 0;
  double mu_dynamic = 0;
};

/// Holds the proxy of a sliding `contact` back: what sticks stays where `last` or the first touch was, what slips follows
/// the border of the cone. The stretch of friction is kept below the surface, where the HIP is, and never read back from
/// the proxy: on a curved surface the two differ, and the difference would add up tick by tick, more at a higher rate.
void holdByFriction(ProxyContact& contact, const FingertipState& last, const Vec3& g, double r,
                    const FrictionCone& cone, Surroundings& surroundings) noexcept;

}  // namespace presa
