#pragma once
#include <cstdint>
#include <vector>

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

}  // namespace presa::ode
