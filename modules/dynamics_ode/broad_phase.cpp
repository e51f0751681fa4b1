#include "modules/dynamics_ode/broad_phase.h"

#include <algorithm>

namespace presa::ode {

BroadPhase::BroadPhase(const BodySet& bodies) {
  bounds_.reserve(bodies.size());
  pairs_.reserve(16 * bodies.size());
}

BroadPhase::Bounds BroadPhase::boundsOf(const BodySet& bodies, std::size_t i, double h, double margin) {
  const auto [box] = bodies.bounds(i);
  const double wider = bodies.reach(i, h) + margin / 2;
  return {{box[0] - wider, box[2] - wider, box[4] - wider},
          {box[1] + wider, box[3] + wider, box[5] + wider},
          static_cast<std::uint32_t>(i),
          bodies.awake(i)};
}

// Of the others only those that come near the bounds of all awake bodies: of thousands at rest, few.
void BroadPhase::measure(const BodySet& bodies, double h, double margin) {
  bounds_.clear();
  Bounds all{{dInfinity, dInfinity, dInfinity}, {-dInfinity, -dInfinity, -dInfinity}, 0, true};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.shapes(i).count == 0 || !bodies.awake(i)) continue;
    const Bounds& one = bounds_.emplace_back(boundsOf(bodies, i, h, margin));
    for (int axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], one.low[axis]);
      all.high[axis] = std::max(all.high[axis], one.high[axis]);
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.shapes(i).count == 0 || bodies.awake(i)) continue;
    const Bounds one = boundsOf(bodies, i, h, margin);
    if (overlap(one, all, 0) && overlap(one, all, 1) && overlap(one, all, 2)) bounds_.push_back(one);
  }
}

// Considers awake bodies only, since a fixed floor extends everywhere.
int BroadPhase::longestAxis() const {
  int longest = 0;
  dReal length = -1;
  for (int axis = 0; axis < 3; ++axis) {
    dReal low = dInfinity, high = -dInfinity;
    for (const Bounds& b : bounds_) {
      if (!b.awake) continue;
      low = std::min(low, b.low[axis]);
      high = std::max(high, b.high[axis]);
    }
    if (high - low > length) {
      longest = axis;
      length = high - low;
    }
  }
  return longest;
}

const std::vector<BroadPhase::Pair>& BroadPhase::find(const BodySet& bodies, double h, double margin) {
  measure(bodies, h, margin);
  pairs_.clear();
  const int x = longestAxis(), y = (x + 1) % 3, z = (x + 2) % 3;
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
