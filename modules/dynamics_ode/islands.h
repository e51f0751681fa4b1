#pragma once
#include <cstdint>
#include <vector>

namespace presa::ode {

/// Groups of free bodies that touch each other (union-find). A fixed body or a finger joins nothing: what lies on one
/// table are separate islands, as ODE sees them too.
class Islands {
 public:
  struct Island {
    std::uint32_t contacts = 0;  ///< with fingers
    bool touched = false;        ///< by a finger
  };
  explicit Islands(std::size_t bodies) : parent_(bodies), islands_(bodies) { reset(); }
  /// Starts over with separate bodies.
  void reset();
  /// The island that a contact between two free bodies would make.
  Island joined(std::size_t a, std::size_t b);
  /// A contact between two free bodies.
  void join(std::size_t a, std::size_t b);
  /// A contact of one free body with something fixed.
  void touch(std::size_t a) { ++islands_[root(a)].contacts; }
  void touchByFinger(std::size_t a);

  /// Name of body `a`'s island, below the number of bodies.
  std::size_t of(std::size_t a) { return root(a); }
  const Island& operator[](std::size_t island) const { return islands_[island]; }

 private:
  std::size_t root(std::size_t a);
  std::vector<std::size_t> parent_;
  std::vector<Island> islands_;
};

}  // namespace presa::ode
