#include "modules/haptics_proxy/god_object.h"

#include <algorithm>
#include <cmath>

#include "framework/haptics/nearest_feasible.h"

namespace presa {
namespace {

// Relative to the fingertip radius, so that metres and millimetres give the same answer. A gap of e r at an edge tilts the
// normal by sqrt(2 e): at 1e-10 that is 1.4e-5, no force one could feel.
constexpr double kTouchGap = 3e-11;     // a sweep stops this far off
constexpr double kInContact = 1e-10;    // a gap below this makes a constraint
constexpr double kStill = 1e-6;         // a leg shorter than this part of r ends the motion: at 8 mm 8 nm, some 10 uN
constexpr double kStillOfDepth = 1e-7;  // or than this part of the depth, where the fingertip is small against it
constexpr double kRounding = 64 * 2.2e-16;  // of the coordinates: no gap is known better
constexpr double kMargin = 0.01;            // of r: how far the fingertip may go before it looks around again
constexpr double kFarther = 1.5;            // near a mesh, of how far the HIP moved
constexpr double kAhead = 5e-3;             // of the last leg: pieces of a mesh that close constrain the next one
constexpr double kMaxAhead = 3e-4;          // of r
constexpr int kMaxRenewals = 8;
constexpr int kMaxLegs = 256;  // a leg per face or edge; curved edges converge by d / r

/// What counts as touching at one place. On a small fingertip rounding of the coordinates is more than a part of r.
struct Tolerance {
  Tolerance(const Vec3& x, const Vec3& g, double r) noexcept {
    const double rounding = kRounding * std::max(x.lpNorm<Eigen::Infinity>(), g.lpNorm<Eigen::Infinity>());
    touch_gap = std::max(kTouchGap * r, rounding);
    contact_gap = std::max(kInContact * r, 3 * rounding);
    still = std::max(kStill * r, kStillOfDepth * (x - g).norm());
  }
  double touch_gap, contact_gap, still;  // [m]
};

/// Everything that the fingertip touches.
struct Holds {
  struct Hold {
    NearPiece piece;
    double offset;  // nhat . y >= offset keeps the fingertip off
  };
  static constexpr int kCapacity = 64;
  std::array<Hold, kCapacity> item;
  int count = 0;
};

// The constraints of one leg and where they let it go.
struct Leg {
  Holds holds;
  bool ahead = false;  // one of them is not touched yet
  HalfSpaces half_spaces;
  Feasible target;
};

// Constraints where the fingertip is now; they also push it out of a body that moved into it. Pieces of a mesh that are no
// farther than `ahead` are among them: their half-spaces lie on the safe side, and the leg goes down to them and along them
// at once.
void findConstraints(const Vec3& x, double r, double ahead, const Tolerance& tolerance, Surroundings& surroundings,
                     Leg& leg) noexcept {
  leg.holds.count = 0;
  leg.ahead = false;
  surroundings.clearMarks();
  surroundings.forEachWithin(x, r + std::max(tolerance.contact_gap, ahead), [&](const NearPiece& piece) {
    const bool touched = piece.at.distance <= r + tolerance.contact_gap;
    if (!touched && piece.ref.source < 0) return;
    if (leg.holds.count == Holds::kCapacity) return;  // not marked, so a sweep stops at it
    leg.holds.item[static_cast<std::size_t>(leg.holds.count++)] = {piece, piece.at.nhat.dot(x) + r - piece.at.distance};
    leg.ahead = leg.ahead || !touched;
    surroundings.mark(piece.ref);
  });
}

// How far y is on the wrong side of a hold [m].
double lack(const Holds::Hold& hold, const Vec3& y) noexcept { return hold.offset - hold.piece.at.nhat.dot(y); }

// The programme over all holds. Where they are more than it has room for, those that bind are found one by one: each round
// takes in the one most violated, and leaves out one that did not bind.
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
    double most = 1e-9 * (leg.target.y - g).norm();
    for (int i = 0; i < leg.holds.count; ++i) {
      const double l = lack(leg.holds.item[static_cast<std::size_t>(i)], leg.target.y);
      if (l > most) {
        most = l;
        worst = i;
      }
    }
    if (worst < 0) return;
    int idle = 0;
    while (std::ranges::find(leg.target.active, idle) != leg.target.active.end()) ++idle;
    const Holds::Hold& hold = leg.holds.item[static_cast<std::size_t>(worst)];
    // the next one that is idle, in turn, so that no two of them replace each other for ever
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

// The body whose constraint holds the proxy back most.
std::int32_t holdingBody(const Leg& leg, const Vec3& g) noexcept {
  std::int32_t body = kNoBody;
  double most = 0;
  for (int a = 0; a < leg.target.active_count; ++a) {
    const HalfSpace& active =
        leg.half_spaces.item[static_cast<std::size_t>(leg.target.active[static_cast<std::size_t>(a)])];
    if (const double l = active.offset - active.nhat.dot(g); body == kNoBody || l > most) {
      most = l;
      body = leg.holds.item[static_cast<std::size_t>(active.tag)].piece.body;
    }
  }
  return body;
}

// Where a motion looks: while the fingertip's centre is within `margin` of `center`, what is in focus is all that it can touch.
struct Look {
  Vec3 center;
  double margin;

  void at(const Vec3& x, double r, Surroundings& surroundings) noexcept {
    center = x;
    surroundings.focus(x, r + margin);
  }
  double room(const Vec3& x) const noexcept { return margin - (x - center).norm(); }
};

// Fraction of `move` that the fingertip can go, at most `limit`.
double freeFraction(const Vec3& x, const Vec3& move, double limit, double r, const Tolerance& tolerance,
                    Surroundings& surroundings, const Leg& leg) noexcept {
  double reach = std::min(1.0, limit);
  for (int i = 0; i < leg.holds.count; ++i) {
    // The half-space of a hold keeps the sphere off it. Where the holds have no common point it may not: then the centre
    // comes no nearer than half way, since the distance lies above its tangent plane.
    const Nearest& at = leg.holds.item[static_cast<std::size_t>(i)].piece.at;
    const double slope = at.nhat.dot(move);
    if (slope < 0) reach = std::min(reach, (at.distance - 0.5 * std::min(at.distance, r)) / -slope);
  }
  return std::min(reach, surroundings.firstTouch(x, move, reach, r, {tolerance.touch_gap, tolerance.contact_gap}));
}

// No farther from a surface than a leg round an edge ends.
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
  Look look{start, surroundings.meshCount() == 0
                       ? kMargin * r
                       : kFarther * surroundings.step() + 0.1 * kMargin * r + 10 * tolerance.still};
  look.at(start, r, surroundings);
  bool met = false, arrived = false;
  double ahead = 0;
  int renewals = 0;
  for (int i = 0; i < kMaxLegs; ++i) {
    if (surroundings.full() && renewals < kMaxRenewals) {
      surroundings.renew(result.x);
      ++renewals;
      look.at(result.x, r, surroundings);
    }
    if (look.room(result.x) < 0.1 * look.margin) {
      look.margin *= 2;  // a long way is looked at in ever larger parts
      look.at(result.x, r, surroundings);
    }
    findConstraints(result.x, r, ahead, tolerance, surroundings, leg);
    if (leg.holds.count > 0 && !met) {
      met = true;
      result.first_touch = result.x;
    }
    solve(result.x, g, leg);
    result.touching = leg.target.active_count > 0;
    if (result.touching) {
      result.body = holdingBody(leg, g);
      result.active = activeSet(leg);
    }
    const Vec3 move = leg.target.y - result.x;
    const double length = move.norm();
    arrived = length <= tolerance.still;
    if (arrived && surroundings.full() && renewals < kMaxRenewals) continue;  // by what has no room: look again
    if (arrived) {
      // what is not quite touched yet is now; otherwise there is nothing to be gained
      if (leg.ahead) result.x = leg.target.y;
      break;
    }
    const double limit = look.room(result.x) / length;
    const double fraction = freeFraction(result.x, move, limit, r, tolerance, surroundings, leg);
    result.x += fraction * move;
    surroundings.leaveTrail(result.x);
    ahead = std::min(kAhead * fraction * length, kMaxAhead * r);
  }
  if (!met) result.first_touch = result.x;
  // out of legs between one edge and the next: what held it last still does, and the next tick goes on from here
  if (!arrived && result.body != kNoBody && isNear(result.x, r, surroundings)) result.touching = true;
  if (!result.touching) {
    result.body = kNoBody;
    result.active.count = 0;
  }
  return result;
}

ProxyContact slideProxy(const FingertipState& last, const Vec3& g, double r, Surroundings& surroundings) noexcept {
  ProxyContact contact;
  surroundings.use(Point::kGodObject);
  // the frictionless point goes on from where it was: it has little way to go, whatever friction holds back
  const ProxyMove bare = moveProxy(last.god, g, r, surroundings);
  contact.x = contact.state.x = contact.state.god = bare.x;
  contact.depth = (bare.x - g).norm();
  if (!bare.touching || !(contact.depth > 0)) {
    contact.depth = 0;
    return contact;
  }
  contact.state.touching = contact.state.slipping = true;
  contact.first_touch = bare.first_touch;
  contact.body = bare.body;
  contact.nhat = (bare.x - g) / contact.depth;
  contact.active = bare.active;
  return contact;
}

}  // namespace presa
