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
constexpr double kStill = 1e-9;       // a leg shorter than this ends the motion
constexpr int kMaxLegs = 24;          // a leg per face or edge crossed in one tick; curved edges converge by d / r

// Fraction of `move` after which x leaves the sphere; 1 when it stays inside.
double insideCover(const Surroundings::Cover& cover, const Vec3& x, const Vec3& move, double r) noexcept {
  const double limit = cover.radius - r;
  const Vec3 from = x - cover.center;
  if ((from + move).squaredNorm() <= limit * limit && limit > 0) return 1;
  const double a = move.squaredNorm(), b = from.dot(move), c = from.squaredNorm() - limit * limit;
  if (limit <= 0 || c >= 0) return b < 0 ? 1 : 0;   // outside already: only inwards
  return std::clamp((-b + std::sqrt(std::max(0.0, b * b - a * c))) / a, 0.0, 1.0);
}

}  // namespace

bool isClear(const Vec3& x, double r, const Surroundings& surroundings) noexcept {
  for (int i = 0; i < surroundings.count; ++i) {
    if (nearest(surroundings.pieces[static_cast<std::size_t>(i)], x).distance < r * (1 - kInContact)) return false;
  }
  return true;
}

ProxyMove moveProxy(const Vec3& start, const Vec3& g, double r, const Surroundings& surroundings) noexcept {
  ProxyMove result;
  result.x = start;
  bool met = false;
  for (int leg = 0; leg < kMaxLegs; ++leg) {
    // constraints where the fingertip is now; also pushes it out of a body that moved into it
    HalfSpaces half_spaces;
    std::array<bool, Surroundings::kCapacity> holds;   // NOLINT: filled below for the pieces in use
    for (int i = 0; i < surroundings.count; ++i) {
      const ConvexPiece& piece = surroundings.pieces[static_cast<std::size_t>(i)];
      const Nearest at = nearest(piece, result.x);
      const bool near = at.distance <= r * (1 + kInContact);
      holds[static_cast<std::size_t>(i)] = near;
      if (!near) continue;
      half_spaces.add({at.nhat, at.nhat.dot(result.x) + r - at.distance, i}, result.x);
    }
    if (half_spaces.count > 0 && !met) {
      met = true;
      result.first_touch = result.x;
    }

    const Feasible target = nearestFeasible(half_spaces, g);
    result.touching = target.active_count > 0;
    result.body = kNoBody;
    double most = 0;
    for (int a = 0; a < target.active_count; ++a) {
      const HalfSpace& active = half_spaces.item[static_cast<std::size_t>(target.active[static_cast<std::size_t>(a)])];
      if (const double lack = active.offset - active.nhat.dot(g); result.body == kNoBody || lack > most) {
        most = lack;
        result.body = surroundings.pieces[static_cast<std::size_t>(active.tag)].body;
      }
    }

    const Vec3 move = target.y - result.x;
    if (move.norm() <= kStill * r) break;
    double reach = 1;
    for (int c = 0; c < surroundings.cover_count; ++c) {
      const double inside = insideCover(surroundings.covers[static_cast<std::size_t>(c)], result.x, move, r);
      if (inside < reach) {
        reach = inside;
        result.covered = false;
      }
    }
    // a piece that already constrains the leg cannot be hit by it: its half-space keeps the sphere off
    for (int i = 0; i < surroundings.count; ++i) {
      if (holds[static_cast<std::size_t>(i)]) continue;
      const double s = firstTouch(surroundings.pieces[static_cast<std::size_t>(i)], result.x, move, r, kTouchGap * r);
      if (s < reach) {
        reach = s;
        result.covered = true;
      }
    }
    result.x += reach * move;
    if (!result.covered) break;
  }
  if (!met) result.first_touch = result.x;
  return result;
}

}  // namespace presa
