// God-object with finite radius [Zilles1995], [Ruspini1997]. A motion is a sequence of legs: find the touched pieces,
// solve the quadratic programme over their half-spaces (nearest_feasible.h), move towards its solution until the first
// new contact (swept with Newton's method, convex_piece.h), and repeat until a leg is shorter than the tolerance.
// Invariants: the sphere never passes a piece; a leg keeps the centre at half its distance from every touched piece;
// tolerances are relative to r and not below the rounding of the coordinates.
#include "modules/god_object/god_object.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/haptics/nearest_feasible.h"

namespace presa {
namespace {

// Relative to the fingertip radius r, so that metres and millimetres give the same answer. A gap of e r at an edge
// tilts the normal by sqrt(2 e): 1.4e-5 rad at 1e-10, an imperceptible force.
constexpr double kTouchGap = 3e-11;         // gap at which a sweep stops
constexpr double kInContact = 1e-10;        // a gap below this makes a constraint
constexpr double kStill = 1e-6;             // a shorter leg ends the motion: 8 nm for 8 mm, some 10 uN
constexpr double kStillOfDepth = 1e-7;      // likewise relative to the depth, for small fingertips
constexpr double kRounding = 64 * 2.2e-16;  // accuracy of a gap relative to the coordinates
constexpr double kMargin = 1e-3;            // distance moved near a mesh before it is queried again, relative to r
constexpr double kFarther = 1.5;            // added to it, relative to the HIP's step
constexpr double kAhead = 5e-3;             // mesh pieces this close, relative to the last leg, constrain the next leg
constexpr double kMaxAhead = 3e-4;          // limit of that distance, relative to r
constexpr int kMaxRenewals = 8;
constexpr int kMaxLegs = 256;  // one leg per face or edge; on curved edges the legs converge as d / r

/// Tolerances of one motion [m]. For a small fingertip the rounding of the coordinates exceeds the relative tolerances.
struct Tolerance {
  Tolerance(const Vec3& x, const Vec3& g, double r) noexcept {
    const double rounding = kRounding * std::max(x.lpNorm<Eigen::Infinity>(), g.lpNorm<Eigen::Infinity>());
    touch_gap = std::max(kTouchGap * r, rounding);
    contact_gap = std::max(kInContact * r, 3 * rounding);
    still = std::max(kStill * r, kStillOfDepth * (x - g).norm());
  }
  double touch_gap, contact_gap, still;  // [m]
};

/// The constraints of the touched pieces.
struct Holds {
  struct Hold {
    NearPiece piece;
    double offset;  // half-space nhat . y >= offset keeps the sphere off the piece
  };
  static constexpr int kCapacity = 64;
  std::array<Hold, kCapacity> item;
  int count = 0;
};

// One leg: its constraints and its target.
struct Leg {
  Holds holds;
  bool ahead = false;  // some constraint belongs to a piece not touched yet
  HalfSpaces half_spaces;
  Feasible target;
};

// Collects the constraints at x; they also push the fingertip out of a body that moved into it. Mesh pieces closer than
// `ahead` are included: their half-spaces are conservative, and the leg then moves down to them and along them at once.
void findConstraints(const Vec3& x, double r, double ahead, const Tolerance& tolerance, Surroundings& surroundings,
                     Leg& leg) noexcept {
  leg.holds.count = 0;
  leg.ahead = false;
  surroundings.clearMarks();
  surroundings.forEachWithin(x, r + std::max(tolerance.contact_gap, ahead), [&](const NearPiece& piece) {
    const bool touched = piece.at.distance <= r + tolerance.contact_gap;
    if (!touched && piece.ref.source < 0) return;
    if (leg.holds.count == Holds::kCapacity) return;  // stays unmarked, so the sweep stops at it
    leg.holds.item[static_cast<std::size_t>(leg.holds.count++)] = {piece, piece.at.nhat.dot(x) + r - piece.at.distance};
    leg.ahead = leg.ahead || !touched;
    surroundings.mark(piece.ref);
  });
}

// Violation of a constraint at y [m].
double violation(const Holds::Hold& hold, const Vec3& y) noexcept { return hold.offset - hold.piece.at.nhat.dot(y); }

// Solves the programme over all constraints. If they exceed the capacity of HalfSpaces, the binding ones are found
// iteratively: each round replaces an inactive constraint by the most violated one.
void solve(const Vec3& x, const Vec3& g, Leg& leg) noexcept {
  constexpr int kMaxRounds = 64;
  HalfSpaces& set = leg.half_spaces;
  set.count = 0;
  bool all = true;
  for (int i = 0; i < leg.holds.count; ++i) {
    const Holds::Hold& hold = leg.holds.item[static_cast<std::size_t>(i)];
    all = set.add({hold.piece.at.nhat, hold.offset, i}, x) && all;
  }
  leg.target = nearestFeasible(set, g);
  for (int round = 0; !all && round < kMaxRounds; ++round) {
    int worst = -1;
    double max = 1e-9 * (leg.target.y - g).norm();
    for (int i = 0; i < leg.holds.count; ++i) {
      const double l = violation(leg.holds.item[static_cast<std::size_t>(i)], leg.target.y);
      if (l > max) {
        max = l;
        worst = i;
      }
    }
    if (worst < 0) return;
    int idle = 0;
    while (std::ranges::find(leg.target.active, idle) != leg.target.active.end()) ++idle;
    const Holds::Hold& hold = leg.holds.item[static_cast<std::size_t>(worst)];
    // replace inactive constraints in turn, so that no two of them alternate for ever
    set.item[static_cast<std::size_t>(idle)] = {hold.piece.at.nhat, hold.offset, worst};
    std::rotate(set.item.begin() + idle, set.item.begin() + idle + 1, set.item.begin() + set.count);
    leg.target = nearestFeasible(set, g);
  }
}

ActiveSet activeSet(const Leg& leg) noexcept {
  ActiveSet active;
  for (int a = 0; a < leg.target.active_count; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const HalfSpace& half_space = leg.half_spaces.item[static_cast<std::size_t>(leg.target.active[n])];
    const NearPiece& piece = leg.holds.item[static_cast<std::size_t>(half_space.tag)].piece;
    active.member[n] = {piece.ref, piece.body, half_space.nhat, leg.target.weight[n]};
  }
  active.count = leg.target.active_count;
  return active;
}

// The body of the constraint that is violated most at g.
std::int32_t holdingBody(const Leg& leg, const Vec3& g) noexcept {
  std::int32_t body = kNoBody;
  double max = 0;
  for (int a = 0; a < leg.target.active_count; ++a) {
    const HalfSpace& active =
        leg.half_spaces.item[static_cast<std::size_t>(leg.target.active[static_cast<std::size_t>(a)])];
    if (const double l = active.offset - active.nhat.dot(g); body == kNoBody || l > max) {
      max = l;
      body = leg.holds.item[static_cast<std::size_t>(active.tag)].piece.body;
    }
  }
  return body;
}

// The region queried by a motion: while the centre stays within `margin` of `center`, the focus holds everything it can
// touch.
struct NearQuery {
  Vec3 center;
  double margin;

  void at(const Vec3& x, double r, Surroundings& surroundings) noexcept {
    center = x;
    surroundings.focus(x, r + margin);
  }
  double room(const Vec3& x) const noexcept { return margin - (x - center).norm(); }
};

// Fraction of `move` that the fingertip can move, at most `limit`.
double freeFraction(const Vec3& x, const Vec3& move, double limit, double r, const Tolerance& tolerance,
                    Surroundings& surroundings, const Leg& leg) noexcept {
  double reach = std::min(1.0, limit);
  for (int i = 0; i < leg.holds.count; ++i) {
    // The half-space of a constraint keeps the sphere off its piece. If the constraints have no common point this may
    // fail; then the centre still keeps half its distance, because the distance lies above its tangent plane.
    const Nearest& at = leg.holds.item[static_cast<std::size_t>(i)].piece.at;
    const double slope = at.nhat.dot(move);
    if (slope < 0) reach = std::min(reach, (at.distance - 0.5 * std::min(at.distance, r)) / -slope);
  }
  return std::min(reach, surroundings.firstTouch(x, move, reach, r, {tolerance.touch_gap, tolerance.contact_gap}));
}

// Whether x is as close to a surface as at the end of a leg round an edge.
bool isNear(const Vec3& x, double r, Surroundings& surroundings) noexcept {
  constexpr double kOffAnEdge = 1e-2;
  bool near = false;
  surroundings.focus(x, r * (1 + kOffAnEdge));
  surroundings.forEachWithin(x, r * (1 + kOffAnEdge), [&](const NearPiece&) { near = true; });
  return near;
}

}  // namespace

bool isSupported(const Vec3& x, double r, Surroundings& surroundings) noexcept {
  const Tolerance tolerance(x, x, r);
  bool touching = false, overlapping = false;
  surroundings.focus(x, r + tolerance.contact_gap);
  surroundings.forEachWithin(x, r + tolerance.contact_gap, [&](const NearPiece& piece) {
    touching = true;
    overlapping = overlapping || piece.at.distance < r - tolerance.contact_gap;
  });
  return touching && !overlapping;
}

ProxyMove moveProxy(const Vec3& start, const Vec3& g, double r, Surroundings& surroundings) noexcept {
  ProxyMove result;
  result.x = start;
  const Tolerance tolerance(start, g, r);
  Leg leg;
  // a query looks at all primitives anyway, so without meshes one serves the whole motion
  NearQuery query{start, surroundings.meshCount() == 0
                             ? std::numeric_limits<double>::infinity()
                             : kFarther * surroundings.step() + kMargin * r + 10 * tolerance.still};
  query.at(start, r, surroundings);
  bool met = false, arrived = false;
  double ahead = 0;
  int renewals = 0;
  for (int i = 0; i < kMaxLegs; ++i) {
    if (surroundings.full() && renewals < kMaxRenewals) {
      surroundings.renew(result.x);
      ++renewals;
      query.at(result.x, r, surroundings);
    }
    if (query.room(result.x) < 0.1 * query.margin) {
      query.margin *= 2;  // a long motion is queried in ever larger parts
      query.at(result.x, r, surroundings);
    }
    findConstraints(result.x, r, ahead, tolerance, surroundings, leg);
    if (leg.holds.count > 0 && !met) {
      met = true;
      result.first_touch = result.x;
    }
    solve(result.x, g, leg);
    result.touching = leg.target.active_count > 0;
    if (result.touching) result.body = holdingBody(leg, g);
    const Vec3 move = leg.target.y - result.x;
    const double length = move.norm();
    arrived = length <= tolerance.still;
    if (arrived && surroundings.full() && renewals < kMaxRenewals) continue;  // held by a solid node: reseed
    if (arrived) {
      // move the last bit to pieces that are not quite touched yet
      if (leg.ahead) result.x = leg.target.y;
      break;
    }
    const double limit = query.room(result.x) / length;
    const double fraction = freeFraction(result.x, move, limit, r, tolerance, surroundings, leg);
    result.x += fraction * move;
    surroundings.leaveTrail(result.x);
    ahead = std::min(kAhead * fraction * length, kMaxAhead * r);
  }
  if (!met) result.first_touch = result.x;
  // out of legs between one edge and the next: the last contact still holds, and the next tick continues from here
  if (!arrived && result.body != kNoBody && isNear(result.x, r, surroundings)) result.touching = true;
  if (!result.touching) result.body = kNoBody;
  if (leg.target.active_count > 0) result.active = activeSet(leg);
  return result;
}

ProxyContact slideProxy(const ProxyState& last, const Vec3& g, double r, Surroundings& surroundings) noexcept {
  surroundings.use(Point::kGodObject);
  // the frictionless point continues from its own last position, so its way is short even when friction holds the proxy
  // back
  return contactOf(moveProxy(last.god_object, g, r, surroundings), g);
}

}  // namespace presa
