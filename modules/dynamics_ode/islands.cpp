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

void Islands::join(std::size_t a, std::size_t b) {
  const auto [low, high] = std::minmax({root(a), root(b)});
  ++islands_[low].contacts;
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

}  // namespace presa::ode
