#pragma once
#include <cstdint>
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"

namespace presa::ode {

/// Groups of free bodies in mutual contact (union-find). Fixed bodies and fingers join nothing: bodies on one table are
/// separate islands, as in ODE.
class Islands {
 public:
  struct Island {
    std::uint32_t contacts = 0;  ///< contacts, including those with fingers
    bool touched = false;        ///< a finger touches it
  };
  explicit Islands(std::size_t bodies) : parent_(bodies), islands_(bodies) { reset(); }
  /// Resets to one island per body.
  void reset();
  /// The island that a contact between two free bodies would make.
  Island joined(std::size_t a, std::size_t b);
  /// Adds a contact between two free bodies.
  void join(std::size_t a, std::size_t b);
  /// Makes one island of two free bodies that a joint holds together.
  void link(std::size_t a, std::size_t b);
  /// Adds a contact between a free body and something fixed.
  void touch(std::size_t a) { ++islands_[root(a)].contacts; }
  void touchByFinger(std::size_t a);

  /// Identifier of body `a`'s island, less than the number of bodies.
  std::size_t of(std::size_t a) { return root(a); }
  const Island& operator[](std::size_t island) const { return islands_[island]; }

 private:
  std::size_t root(std::size_t a);
  std::vector<std::size_t> parent_;
  std::vector<Island> islands_;
};

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
