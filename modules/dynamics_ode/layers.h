#pragma once
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"

namespace presa::ode {

/// Layer count that imposes no limit on the iterations.
inline constexpr int kAllLayers = 1000;

/// Height of stacks in bodies: layer 1 touches something fixed, layer 2 touches layer 1, and so on. A sweep of the
/// iterative solver propagates a load by one layer; as for any chain, convergence takes in the order of layers^2
/// sweeps.
class Layers {
 public:
  explicit Layers(std::size_t bodies) : layer_(bodies) {}

  /// The highest layer, or 0 without contacts.
  int count(const std::vector<BodyContact>& contacts, const BodySet& bodies);

 private:
  std::vector<int> layer_;  // by body; 0: not reached yet
};

}  // namespace presa::ode
