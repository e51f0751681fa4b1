#include "modules/dynamics_ode/layers.h"

#include <algorithm>

namespace presa::ode {

int Layers::count(const std::vector<BodyContact>& contacts, const BodySet& bodies) {
  std::fill(layer_.begin(), layer_.end(), 0);
  int highest = 0;
  const auto reach = [&](std::size_t body, int layer) {
    if (!bodies.moves(body) || layer_[body] != 0) return false;
    layer_[body] = highest = layer;
    return true;
  };
  bool grows = true;
  for (int below = 0; grows; ++below) {
    grows = false;
    for (const BodyContact& contact : contacts) {
      const auto A = static_cast<std::size_t>(contact.A), B = static_cast<std::size_t>(contact.B);
      const auto holds = [&](std::size_t body) { return below == 0 ? !bodies.moves(body) : layer_[body] == below; };
      if (holds(A) && reach(B, below + 1)) grows = true;
      if (holds(B) && reach(A, below + 1)) grows = true;
    }
  }
  return highest;
}

}  // namespace presa::ode
