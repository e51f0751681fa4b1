#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

/// Process-wide and per-thread state of ODE, as opposed to that of a world.
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

}  // namespace presa::ode
