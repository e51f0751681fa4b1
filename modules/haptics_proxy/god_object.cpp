#include "modules/haptics_proxy/god_object.h"

#include <algorithm>
#include <cmath>

#include "modules/haptics_proxy/nearest_feasible.h"

namespace presa {
namespace {

// All relative to the fingertip radius, so that metres and millimetres give the same answer. A gap of e r at an
// edge tilts the normal by sqrt(2 e): at 1e-10 that is 1.4e-5, no force one could feel; below, rounding would show.
constexpr double kTouchGap = 3e-11;   // a sweep stops this far off
constexpr double kInContact = 1e-10;  // a gap below this makes a constraint
constexpr double kStill = 1e-6;       // a leg shorter than this ends the motion: 8 nm, some 10 uN
constexpr double kMargin = 0.01;      // how far the fingertip may go before it looks around again
constexpr double kSpare = 0.25;       // how much farther a new look reaches: it serves until the fingertip left it
constexpr int kMaxLegs = 64;          // a leg per face, edge or look; curved edges converge by d / r

// Fraction of `move` after which x leaves the sphere; 1 when it stays inside.
double insideCover(const Surroundings::Cover& cover, const Vec3& x, const Vec3& move, double r) noexcept {
  const double limit = cover.radius - r;
  const Vec3 from = x - cover.center;
  if ((from + move).squaredNorm() <= limit * limit && limit > 0) return 1;
  const double a = move.squaredNorm(), b = from.dot(move), c = from.squaredNorm() - limit * limit;
  if (limit <= 0 || c >= 0) return b < 0 ? 1 : 0;  // outside already: only inwards
  return std::clamp((-b + std::sqrt(std::max(0.0, b * b - a * c))) / a, 0.0, 1.0);
}

// What the legs of one motion share.
struct Legs {
  Vec3 center;        // of the last look
  double margin = 0;  // how far from there the fingertip may go
  int near_count = 0;
  std::array<int, Surroundings::kCapacity> near;    // NOLINT: pieces that can be met on the way
  std::array<bool, Surroundings::kCapacity> holds;  // NOLINT: as `near`: the piece constrains the leg
  HalfSpaces half_spaces;
  Feasible target;

  void look(const Vec3& x, double r, Surroundings& surroundings) noexcept {
    center = x;
    surroundings.lookAround(x, r + margin, kSpare * r);
    near_count = 0;
    for (int i = 0; i < surroundings.count(); ++i) {
      if (surroundings.atLeast(i, x) <= r + margin) near[static_cast<std::size_t>(near_count++)] = i;
    }
  }
};

// Constraints where the fingertip is now; they also push it out of a body that moved into it.
void findConstraints(const Vec3& x, double r, Surroundings& surroundings, Legs& legs) noexcept {
  legs.half_spaces.count = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(legs.near_count); ++n) {
    const int i = legs.near[n];
    legs.holds[n] = false;
    if (surroundings.atLeast(i, x) > r * (1 + 2 * kInContact)) continue;
    const Nearest at = surroundings.nearestTo(i, x);
    legs.holds[n] = at.distance <= r * (1 + kInContact);
    if (legs.holds[n]) legs.half_spaces.add({at.nhat, at.nhat.dot(x) + r - at.distance, i}, x);
  }
}

// No farther from a surface than a leg round an edge ends.
bool isNear(const Vec3& x, double r, Surroundings& surroundings, const Legs& legs) noexcept {
  constexpr double kOffAnEdge = 1e-2;
  for (std::size_t n = 0; n < static_cast<std::size_t>(legs.near_count); ++n) {
    const int i = legs.near[n];
    if (surroundings.atLeast(i, x) <= r * (1 + kOffAnEdge) &&
        surroundings.nearestTo(i, x).distance <= r * (1 + kOffAnEdge))
      return true;
  }
  return false;
}

// The body whose constraint holds the proxy back most.
std::int32_t holdingBody(const Legs& leg, const Vec3& g, const Surroundings& surroundings) noexcept {
  std::int32_t body = kNoBody;
  double most = 0;
  for (int a = 0; a < leg.target.active_count; ++a) {
    const HalfSpace& active =
        leg.half_spaces.item[static_cast<std::size_t>(leg.target.active[static_cast<std::size_t>(a)])];
    if (const double lack = active.offset - active.nhat.dot(g); body == kNoBody || lack > most) {
      most = lack;
      body = surroundings.piece(active.tag).body;
    }
  }
  return body;
}

// Fraction of `move` that the fingertip can go; `covered` turns false when the border of a patch ends it.
double freeFraction(const Vec3& x, const Vec3& move, double limit, double r, Surroundings& surroundings,
                    const Legs& leg, bool& covered) noexcept {
  const double length = move.norm();
  double reach = std::min(1.0, limit / length);
  for (int c = 0; c < surroundings.coverCount(); ++c) {
    if (const double inside = insideCover(surroundings.cover(c), x, move, r); inside < reach) {
      reach = inside;
      covered = false;
    }
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(leg.near_count); ++n) {
    const int i = leg.near[n];
    // the bound is linear: it reaches r within this leg, or nothing does
    if (surroundings.atLeast(i, x) + std::min(0.0, reach * surroundings.growth(i, move)) > r) continue;
    // a piece that already constrains the leg cannot be hit by it: its half-space keeps the sphere off
    if (leg.holds[n]) continue;
    const Nearest at = surroundings.nearestTo(i, x);
    if (const double s = firstTouch(surroundings.piece(i), at, x, move, reach, r, kTouchGap * r); s < reach) {
      reach = s;
      covered = true;
    }
  }
  return reach;
}

}  // namespace

bool isSupported(const Vec3& x, double r, Surroundings& surroundings) noexcept {
  surroundings.lookAround(x, r * (1 + 2 * kInContact), kSpare * r);
  bool touching = false;
  for (int i = 0; i < surroundings.count(); ++i) {
    // what touches already spares the exact distance of pieces that cannot overlap
    if (surroundings.atLeast(i, x) > r * (touching ? 1 - 0.5 * kInContact : 1 + 2 * kInContact)) continue;
    const double distance = surroundings.nearestTo(i, x).distance;
    if (distance < r * (1 - kInContact)) return false;
    touching = touching || distance <= r * (1 + kInContact);
  }
  return touching;
}

ProxyMove moveProxy(const Vec3& start, const Vec3& g, double r, Surroundings& surroundings) noexcept {
  ProxyMove result;
  result.x = start;
  Legs legs;
  legs.margin = kMargin * r;
  legs.look(start, r, surroundings);
  bool met = false, arrived = false;
  for (int i = 0; i < kMaxLegs && result.covered; ++i) {
    if ((result.x - legs.center).norm() > 0.9 * legs.margin) {
      legs.margin *= 2;  // a long way is looked at in ever larger parts: the number of legs is bounded
      legs.look(result.x, r, surroundings);
    }
    findConstraints(result.x, r, surroundings, legs);
    if (legs.half_spaces.count > 0 && !met) {
      met = true;
      result.first_touch = result.x;
    }
    legs.target = nearestFeasible(legs.half_spaces, g);
    result.touching = legs.target.active_count > 0;
    if (result.touching) result.body = holdingBody(legs, g, surroundings);
    const Vec3 move = legs.target.y - result.x;
    arrived = move.norm() <= kStill * r;
    if (arrived) break;
    const double room = legs.margin - (result.x - legs.center).norm();
    result.x += freeFraction(result.x, move, room, r, surroundings, legs, result.covered) * move;
  }
  if (!met) result.first_touch = result.x;
  // out of legs between one edge and the next: what held it last still does, and the next tick goes on from here
  if (!arrived && result.covered && result.body != kNoBody && isNear(result.x, r, surroundings, legs))
    result.touching = true;
  if (!result.touching) result.body = kNoBody;
  return result;
}

ProxyHolds proxyHolds(const Vec3& x, const Vec3& g, double r, Surroundings& surroundings) noexcept {
  Legs legs;
  legs.margin = kMargin * r;
  legs.look(x, r, surroundings);
  findConstraints(x, r, surroundings, legs);
  const Feasible target = nearestFeasible(legs.half_spaces, g);
  ProxyHolds holds;
  for (int a = 0; a < target.active_count; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const HalfSpace& active = legs.half_spaces.item[static_cast<std::size_t>(target.active[n])];
    holds.item[n] = {active.tag, active.nhat, target.weight[n]};
  }
  holds.count = target.active_count;
  return holds;
}

ProxyContact slideProxy(const FingertipState& last, const Vec3& g, double r, Surroundings& surroundings) noexcept {
  ProxyContact contact;
  // the frictionless point goes on from where it was: it has little way to go, whatever friction holds back
  const ProxyMove bare = moveProxy(last.god, g, r, surroundings);
  contact.x = contact.state.x = contact.state.god = bare.x;
  contact.covered = bare.covered;
  contact.depth = (bare.x - g).norm();
  if (!bare.touching || !(contact.depth > 0)) {
    contact.depth = 0;
    return contact;
  }
  contact.state.touching = contact.state.slipping = true;
  contact.first_touch = bare.first_touch;
  contact.body = bare.body;
  contact.nhat = (bare.x - g) / contact.depth;
  return contact;
}

}  // namespace presa
