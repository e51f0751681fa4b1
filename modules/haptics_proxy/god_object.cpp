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
constexpr double kMargin = 0.06;      // how far the fingertip may go before it looks around again
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

// What the legs of one motion share. A piece's distance changes by no more than the fingertip moves, so most pieces
// need looking at once, not once a leg.
struct Legs {
  HalfSpaces half_spaces;
  std::array<double, Surroundings::kCapacity>
      clearance;                                    // NOLINT: lower bounds of the distances from x, for pieces in use
  std::array<bool, Surroundings::kCapacity> holds;  // NOLINT: the piece constrains the leg
  Feasible target;

  void look(const Vec3& x, double r, double margin, Surroundings& surroundings) noexcept {
    surroundings.lookAround(x, r, margin);
    for (int i = 0; i < surroundings.count(); ++i)
      clearance[static_cast<std::size_t>(i)] = surroundings.distanceBound(i, x);
  }
  void moved(double distance, int count) noexcept {
    for (int i = 0; i < count; ++i) clearance[static_cast<std::size_t>(i)] -= distance;
  }
};

// Constraints where the fingertip is now; they also push it out of a body that moved into it.
void findConstraints(const Vec3& x, double r, const Surroundings& surroundings, Legs& legs) noexcept {
  legs.half_spaces.count = 0;
  for (int i = 0; i < surroundings.count(); ++i) {
    double& clearance = legs.clearance[static_cast<std::size_t>(i)];
    bool& holds = legs.holds[static_cast<std::size_t>(i)];
    holds = false;
    if (clearance > r * (1 + 2 * kInContact)) continue;
    const Nearest at = nearest(surroundings.piece(i), x);
    clearance = at.distance;
    holds = at.distance <= r * (1 + kInContact);
    if (holds) legs.half_spaces.add({at.nhat, at.nhat.dot(x) + r - at.distance, i}, x);
  }
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
double freeFraction(const Vec3& x, const Vec3& move, double limit, double r, const Surroundings& surroundings,
                    const Legs& leg, bool& covered) noexcept {
  const double length = move.norm();
  double reach = std::min(1.0, limit / length);
  for (int c = 0; c < surroundings.coverCount(); ++c) {
    if (const double inside = insideCover(surroundings.cover(c), x, move, r); inside < reach) {
      reach = inside;
      covered = false;
    }
  }
  // a piece that already constrains the leg cannot be hit by it: its half-space keeps the sphere off
  for (int i = 0; i < surroundings.count(); ++i) {
    if (leg.holds[static_cast<std::size_t>(i)]) continue;
    if (leg.clearance[static_cast<std::size_t>(i)] - r > reach * length) continue;
    if (const double s = firstTouch(surroundings.piece(i), x, move, r, kTouchGap * r); s < reach) {
      reach = s;
      covered = true;
    }
  }
  return reach;
}

}  // namespace

bool isClear(const Vec3& x, double r, Surroundings& surroundings) noexcept {
  surroundings.lookAround(x, r, 0);
  for (int i = 0; i < surroundings.count(); ++i) {
    if (nearest(surroundings.piece(i), x).distance < r * (1 - kInContact)) return false;
  }
  return true;
}

ProxyMove moveProxy(const Vec3& start, const Vec3& g, double r, Surroundings& surroundings) noexcept {
  ProxyMove result;
  result.x = start;
  // a long way is looked at in larger parts: the number of legs is bounded
  const double margin = std::max(kMargin * r, (g - start).norm() / 16);
  Vec3 center = start;
  Legs legs;
  surroundings.lookAround(start, r, 1.5 * margin);  // a little more: the next motion of this tick starts close by
  legs.look(center, r, margin, surroundings);
  bool met = false;
  for (int i = 0; i < kMaxLegs; ++i) {
    if ((result.x - center).norm() > 0.9 * margin) {
      center = result.x;
      legs.look(center, r, margin, surroundings);
    }
    findConstraints(result.x, r, surroundings, legs);
    if (legs.half_spaces.count > 0 && !met) {
      met = true;
      result.first_touch = result.x;
    }
    legs.target = nearestFeasible(legs.half_spaces, g);
    result.touching = legs.target.active_count > 0;
    result.body = holdingBody(legs, g, surroundings);
    const Vec3 move = legs.target.y - result.x;
    if (move.norm() <= kStill * r) break;
    const double room = margin - (result.x - center).norm();
    const Vec3 step = freeFraction(result.x, move, room, r, surroundings, legs, result.covered) * move;
    result.x += step;
    legs.moved(step.norm(), surroundings.count());
    if (!result.covered) break;
  }
  if (!met) result.first_touch = result.x;
  return result;
}

}  // namespace presa
