// Successive tangent planes: the parts are convex, so every plane has all of its part on one side, and a motion on the
// other side cannot meet it. Each pass solves the god-object's quadratic programme with the planes at the place that the
// last one reached.
#include "modules/xfca/god_object.h"

#include <algorithm>

namespace presa {
namespace {

constexpr int kPasses = 10;
constexpr double kStill = 1e-8;  // a pass that moves less ends the slide [m]
constexpr double kNearby = 2;    // planes within so many steps are found anew, the others hold as they are

}  // namespace

// Coordinates count from the place of the last separate().
HalfSpaces GodObject::planesWithin(double within, double skin, bool& all) const noexcept {
  HalfSpaces planes;
  all = true;
  const auto& near = pairs_.near();
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i].gap - skin > within) continue;
    all = planes.add({near[i].nhat_W, skin - near[i].gap, static_cast<std::int32_t>(i)}, Vec3::Zero()) && all;
  }
  return planes;
}

double GodObject::deepest() const noexcept {
  double gap = 0;
  for (const NearParts& pair : pairs_.near()) gap = std::min(gap, pair.gap);
  return -gap;
}

bool GodObject::slide(const Quat& q_WT, const Vec3& goal, Vec3& x) noexcept {
  pairs_.separate({x, q_WT}, 2 * (goal - x).norm() + kSkin);
  for (int pass = 0; pass < kPasses; ++pass) {
    bool all = true;
    const HalfSpaces planes = planesWithin(2 * std::max((goal - x).norm(), deepest()) + kSkin, kSkin, all);
    Vec3 step = nearestFeasible(planes, goal - x).y;
    if (!all) {
      // the planes that found no room are farther away than those that did
      complete_ = false;
      double farthest = 0;
      for (int i = 0; i < planes.count; ++i)
        farthest = std::max(farthest, -planes.item[static_cast<std::size_t>(i)].offset);
      if (step.norm() > farthest) step *= farthest / step.norm();
    }
    if (step.norm() <= kStill) return true;
    x += step;
    pairs_.follow(step, kSkin + kNearby * step.norm());
  }
  return false;
}

GodObject::Push GodObject::pushOn(const Vec3& goal, const Vec3& x) const noexcept {
  bool all = true;
  const HalfSpaces planes = planesWithin(2 * (goal - x).norm() + kSkin, 0, all);
  const Feasible there = nearestFeasible(planes, goal - x);
  Push push;
  push.shift = there.y - (goal - x);
  for (int a = 0; a < there.active_count; ++a) {
    const auto i = static_cast<std::size_t>(a);
    push.parts[i] = {planes.item[static_cast<std::size_t>(there.active[i])].nhat, there.weight[i]};
  }
  push.count = there.active_count;
  return push;
}

}  // namespace presa
