#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::ode {

/// An assertion inside ODE failed. Thrown instead of ending the process; only the world concerned is given up.
class OdeFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Initialises ODE once per process, checks that it is the double-precision build (std::runtime_error if not),
/// redirects its messages, and allocates the calling thread's collision memory. Cheap when repeated.
void attachThread();
/// Frees the calling thread's collision memory.
void detachThread();

/// Number of messages that ODE issued on the calling thread (mostly "LCP internal error" of the direct solver). Not
/// printed.
std::uint64_t messageCount() noexcept;

/// Writes at most so many contacts of two geometries; their number. Of meshes one call at a time in the process: another
/// waits, so the haptic thread must not collide meshes beside other threads.
int collide(dGeomID one, dGeomID other, int most, dContactGeom* contacts);

/// One ODE world with the contact joints of one solve, its own queue of solver jobs, and its own state of ODE's global
/// random numbers. Must be created, used and destroyed on one thread; other worlds may step on other threads meanwhile.
/// Failures inside ODE are thrown as OdeFailure.
class Engine {
 public:
  /// Reserves memory for `contacts`; more contacts allocate once.
  Engine(const Vec3& gravity, std::uint64_t seed, std::size_t contacts);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  dWorldID world() const noexcept { return world_; }
  Vec3 gravity() const noexcept;  ///< in W [m/s^2]

  /// Adds a contact joint whose normal points into `first`; `second` may be null. `feedback` must outlive the solve.
  void addContact(const dContact& contact, dBodyID first, dBodyID second, dJointFeedback* feedback);
  void clearContacts();

  /// Steps every enabled body over `h` [s] with the direct solver. False when it failed: the state is then invalid.
  bool solveDirectly(double h);
  /// Steps every enabled body over `h` [s] with the iterative solver.
  void solveIteratively(double h, int iterations);

 private:
  void takeMemory(std::size_t joints);
  dJointID createContact(const dContact& contact);

  struct FreeJobs {
    void operator()(dThreadingImplementationID jobs) const { dThreadingFreeImplementation(jobs); }
  };

  dWorldID world_;
  // by default ODE queues the jobs of all worlds in one list, unguarded: two threads that step would corrupt it
  std::unique_ptr<dxThreadingImplementation, FreeJobs> jobs_;
  std::vector<dJointGroupID> groups_;
  std::size_t joints_ = 0;  // joints in use
  unsigned long random_state_;
};

}  // namespace presa::ode
