#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::ode {

/// One ODE world with the contact joints of one solve, and its own stream of the random numbers that ODE
/// keeps globally. One thread creates, uses and destroys it. ODE's failures come as OdeFailure.
class Engine {
 public:
  /// With room for `contacts` and fingers; more take memory once.
  Engine(const Vec3& gravity, std::uint64_t seed, std::size_t contacts);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  dWorldID world() const noexcept { return world_; }

  /// A contact joint whose normal points into `first`; `second` may be null. `feedback` stays the caller's.
  void addContact(const dContact& contact, dBodyID first, dBodyID second, dJointFeedback* feedback);
  void clearContacts();

  /// Steps every enabled body over `h` [s] by the direct solver. False when it reported trouble: the state is then useless.
  bool solveDirectly(double h);
  /// The same by the iterative solver.
  void solveIteratively(double h, int iterations);

 private:
  void takeMemory(std::size_t joints);
  dJointID createContact(const dContact& contact);

  dWorldID world_;
  std::vector<dJointGroupID> groups_;
  std::size_t joints_ = 0;  // in them
  unsigned long random_state_;
};

}  // namespace presa::ode
