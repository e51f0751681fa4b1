#include "modules/dynamics_ode/broad_phase.h"

#include <algorithm>

namespace presa::ode {

BroadPhase::BroadPhase(const BodySet& bodies) {
  bounds_.reserve(bodies.size());
  pairs_.reserve(16 * bodies.size());
}

void BroadPhase::measure(const BodySet& bodies, double h, double margin) {
  bounds_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.shapes(i).count == 0) continue;
    const auto [box] = bodies.bounds(i);
    const double wider = bodies.reach(i, h) + margin / 2;
    bounds_.push_back({{box[0] - wider, box[2] - wider, box[4] - wider},
                       {box[1] + wider, box[3] + wider, box[5] + wider},
                       static_cast<std::uint32_t>(i),
                       bodies.awake(i)});
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
      if (!(a->awake || b->awake) || a->low[y] > b->high[y] || b->low[y] > a->high[y] || a->low[z] > b->high[z] ||
          b->low[z] > a->high[z]) {
        continue;
      }
      pairs_.push_back(std::minmax<std::size_t>(a->body, b->body));
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace presa::ode
