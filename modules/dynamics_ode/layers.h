#pragma once
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"

namespace presa::ode {

/// In place of a count: as many sweeps as time allows.
inline constexpr int kAllLayers = 1000;

/// How high bodies stand on each other: 1 for what touches something fixed, 2 for what touches that, and so on.
/// A sweep of the iterative solver passes a load on by one layer, and like any chain they converge in the order of layers^2 sweeps.
class Layers {
 public:
  explicit Layers(std::size_t bodies) : layer_(bodies) {}

  /// The highest layer of all, 0 without contacts.
  int count(const std::vector<BodyContact>& contacts, const BodySet& bodies);

 private:
  std::vector<int> layer_;  // by body; 0: not reached yet
};

}  // namespace presa::ode
