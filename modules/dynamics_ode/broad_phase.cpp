#include "modules/dynamics_ode/broad_phase.h"

#include <algorithm>

namespace presa::ode {

BroadPhase::BroadPhase(const BodySet& bodies) {
  bounds_.reserve(bodies.size());
  pairs_.reserve(16 * bodies.size());
}

// In place: a copy of what was just written number by number would wait for that.
void BroadPhase::measure(const BodySet& bodies, std::size_t i, double h, double margin, Bounds& out) {
  const auto [box] = bodies.bounds(i);
  const double wider = bodies.reach(i, h) + margin / 2;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.low[axis] = box[2 * axis] - wider;
    out.high[axis] = box[2 * axis + 1] + wider;
  }
  out.body = static_cast<std::uint32_t>(i);
  out.awake = bodies.awake(i);
}

// Of the others only those that come near the bounds of all awake bodies: of thousands at rest, few.
BroadPhase::Bounds BroadPhase::measure(const BodySet& bodies, double h, double margin) {
  bounds_.clear();
  Bounds all{{dInfinity, dInfinity, dInfinity}, {-dInfinity, -dInfinity, -dInfinity}, 0, true};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.shapes(i).count == 0 || !bodies.awake(i)) continue;
    Bounds& one = bounds_.emplace_back();
    measure(bodies, i, h, margin, one);
    for (int axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], one.low[axis]);
      all.high[axis] = std::max(all.high[axis], one.high[axis]);
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.shapes(i).count == 0 || bodies.awake(i)) continue;
    Bounds one;
    measure(bodies, i, h, margin, one);
    if (overlap(one, all, 0) && overlap(one, all, 1) && overlap(one, all, 2)) bounds_.push_back(one);
  }
  return all;
}

// Of the awake bodies only, since a fixed floor extends everywhere.
int BroadPhase::longestAxis(const Bounds& all) {
  int longest = 0;
  dReal length = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(all.high[axis] - all.low[axis] > length)) continue;
    longest = axis;
    length = all.high[axis] - all.low[axis];
  }
  return longest;
}

const std::vector<BroadPhase::Pair>& BroadPhase::find(const BodySet& bodies, double h, double margin) {
  const Bounds all = measure(bodies, h, margin);
  pairs_.clear();
  const int x = longestAxis(all), y = (x + 1) % 3, z = (x + 2) % 3;
  std::sort(bounds_.begin(), bounds_.end(), [x](const Bounds& a, const Bounds& b) { return a.low[x] < b.low[x]; });
  for (auto a = bounds_.cbegin(); a != bounds_.cend(); ++a) {
    for (auto b = a + 1; b != bounds_.cend() && b->low[x] <= a->high[x]; ++b) {
      if (!(a->awake || b->awake) || !overlap(*a, *b, y) || !overlap(*a, *b, z)) continue;
      if (!bodies.meet(a->body, b->body)) continue;
      pairs_.push_back(std::minmax<std::size_t>(a->body, b->body));
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace presa::ode
