#include "modules/dynamics_ode/islands.h"

#include <algorithm>
#include <numeric>

namespace presa::ode {

void Islands::reset(std::size_t bodies) {
  parent_.resize(bodies);
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  contacts_.assign(bodies, 0);
}

std::size_t Islands::root(std::size_t a) {
  while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
  return a;
}

void Islands::join(std::size_t a, std::size_t b) {
  const auto [low, high] = std::minmax({root(a), root(b)});
  ++contacts_[low];
  if (low == high) return;
  parent_[high] = low;
  contacts_[low] += contacts_[high];
}

void Islands::touch(std::size_t a) { ++contacts_[root(a)]; }

std::uint32_t Islands::contacts(std::size_t a) { return contacts_[root(a)]; }

}  // namespace presa::ode
