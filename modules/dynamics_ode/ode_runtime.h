#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

/// The parts of ODE that belong to the process or the thread, not to a world.
namespace presa::ode {

/// An assertion inside ODE failed. ODE would end the process; here the world it happened in is given up instead.
class OdeFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Starts ODE once per process, checks that it is the double-precision build (std::runtime_error if not), routes its
/// messages here, and gives the calling thread the memory that collision needs. Cheap when repeated.
void attachThread();
/// Frees the calling thread's collision memory.
void detachThread();

/// Messages ODE has given on the calling thread ("LCP internal error" of the direct solver, mostly). Never printed.
std::uint64_t messageCount() noexcept;

}  // namespace presa::ode
