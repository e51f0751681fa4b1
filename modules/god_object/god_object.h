#pragma once
#include <array>
#include <cstdint>

#include "framework/haptics/friction_law.h"
#include "framework/haptics/surroundings.h"

namespace presa {

/// The active constraints of a proxy, at most three. The vector from the goal to the proxy is the sum of weight * nhat.
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
  Vec3 x = Vec3::Zero();            ///< final position of the fingertip's centre
  Vec3 first_touch = Vec3::Zero();  ///< position at the first contact (x if there was none)
  bool touching = false;            ///< a surface keeps the sphere from the goal
  std::int32_t body = kNoBody;      ///< body of the most violated constraint
  ActiveSet active;
};

/// Moves a sphere of radius r from x towards g without passing through any piece, to the local minimum of |x - g|: the
/// god-object with finite radius [Zilles1995], [Ruspini1997]. Each leg goes to the exact solution of the active-set
/// programme and is stopped by the first new contact, found by a sweep. Even with contradicting constraints a leg keeps
/// the centre at half its distance from each piece, so it cannot cross a surface. Tolerances are relative to r, and not
/// below the rounding of the coordinates. Thread: haptic; nonblocking.
ProxyMove moveProxy(const Vec3& x, const Vec3& g, double r, Surroundings& surroundings) noexcept;

/// True when a fingertip at x touches at least one piece and overlaps none.
bool isSupported(const Vec3& x, double r, Surroundings& surroundings) noexcept;

/// State of a fingertip, kept from tick to tick, in the working frame A.
struct FingertipState {
  Vec3 x = Vec3::Zero();           ///< proxy, held by friction
  Vec3 god_object = Vec3::Zero();  ///< frictionless god-object; x itself in free space
  bool touching = false;
  bool slipping = false;
  Vec3 stick_anchor = Vec3::Zero();  ///< stick anchor: friction pulls the HIP towards it; its image on the surface is x
  bool fresh = true;                 ///< friction begins anew in the next tick
  Vec3 g = Vec3::Zero();             ///< HIP, written by friction
  FrictionState friction{};          ///< the law's own
};

/// Contact of one fingertip, in the working frame A.
struct ProxyContact {
  FingertipState state;
  Vec3 x = Vec3::Zero();                        ///< rendered proxy: state.x, unless an effect moves it
  Vec3 first_touch = Vec3::Zero();              ///< position at the first contact of this tick's motion
  Vec3 nhat = Vec3::UnitZ();                    ///< direction of the frictionless force, body into finger
  double depth = 0;                             ///< (x - g) . nhat [m]
  Vec3 tangential_displacement = Vec3::Zero();  ///< tangential displacement: x - g without its normal part [m]
  std::int32_t body = kNoBody;
  ActiveSet active;   ///< active set of the frictionless point
  bool swept = true;  ///< the proxy moves along continuous paths; false: a renderer without memory, which may jump
};

/// One tick of the frictionless god-object towards the HIP g.
ProxyContact slideProxy(const FingertipState& last, const Vec3& g, double r, Surroundings& surroundings) noexcept;

/// The friction of one contact.
struct Friction {
  const FrictionLaw& law;
  double mu_static, mu_dynamic;
  double stiffness;  ///< of the surface [N/m]
  double period;     ///< [s]
  Quat q_BA = Quat::Identity();
};

/// Applies friction to a sliding `contact`: a sticking proxy stays at its last position or at the first touch, a
/// slipping one goes where the law's tangential force puts it. The tangential displacement is stored at the HIP, below
/// the surface, not recomputed from the proxy: on a curved surface the two differ, and the difference would accumulate
/// tick by tick. Writes the law's `answer` if there is a contact. False: the law broke its contract.
bool holdByFriction(ProxyContact& contact, const FingertipState& last, const Vec3& g, double r,
                    const Friction& friction, Surroundings& surroundings, FrictionAnswer& answer) noexcept;

}  // namespace presa
