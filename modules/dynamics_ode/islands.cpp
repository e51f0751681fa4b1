#include "modules/dynamics_ode/islands.h"

#include <algorithm>
#include <numeric>

namespace presa::ode {

void Islands::reset() {
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  std::fill(islands_.begin(), islands_.end(), Island{});
}

std::size_t Islands::root(std::size_t a) {
  while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
  return a;
}

Islands::Island Islands::joined(std::size_t a, std::size_t b) {
  Island all = islands_[root(a)];
  ++all.contacts;
  if (root(a) == root(b)) return all;
  all.contacts += islands_[root(b)].contacts;
  all.touched = all.touched || islands_[root(b)].touched;
  return all;
}

void Islands::join(std::size_t a, std::size_t b) {
  link(a, b);
  ++islands_[root(a)].contacts;
}

void Islands::link(std::size_t a, std::size_t b) {
  const auto [low, high] = std::minmax({root(a), root(b)});
  if (low == high) return;
  parent_[high] = low;
  islands_[low].contacts += islands_[high].contacts;
  islands_[low].touched = islands_[low].touched || islands_[high].touched;
}

void Islands::touchByFinger(std::size_t a) {
  Island& island = islands_[root(a)];
  ++island.contacts;
  island.touched = true;
}

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
