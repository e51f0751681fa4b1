#pragma once
#include <cstdint>
#include <vector>

namespace presa::ode {

/// Groups of free bodies that touch each other (union-find), each with its number of contacts. A fixed body or a
/// finger joins nothing: what lies on one table are separate islands, as ODE sees them too.
class Islands {
 public:
  /// Starts over with `bodies` separate bodies.
  void reset(std::size_t bodies);
  /// A contact between two free bodies.
  void join(std::size_t a, std::size_t b);
  /// A contact of one free body with something fixed, or a finger.
  void touch(std::size_t a);
  /// Contacts in the island of body `a`.
  std::uint32_t contacts(std::size_t a);

 private:
  std::size_t root(std::size_t a);
  std::vector<std::size_t> parent_;
  std::vector<std::uint32_t> contacts_;
};

}  // namespace presa::ode
