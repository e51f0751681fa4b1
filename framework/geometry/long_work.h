#pragma once
#include <exception>
#include <functional>
#include <string>

#include "framework/geometry/surface_distance.h"

/// Work on geometry before a run that can take long. It prints nothing: a program that listens shows how far it is, and
/// may stop it.
namespace presa {

/// During its lifetime `heard` learns how far work has come, between 0 and 1, and says whether it goes on; 1 comes once it
/// is done. Called on the thread that works. Thread: main; one at a time.
class LongWorkListener {
 public:
  using Heard = std::function<bool(const std::string& what, double share)>;  ///< false stops the work
  explicit LongWorkListener(Heard heard);                                    ///< listens from now on
  ~LongWorkListener();
  LongWorkListener(const LongWorkListener&) = delete;
  LongWorkListener& operator=(const LongWorkListener&) = delete;
};

/// Work was told to stop; nothing is wrong with what it worked on.
struct WorkStopped final : std::exception {
  const char* what() const noexcept override { return "stopped"; }  ///< no reason: somebody wanted it
};

/// Tells the listener of this thread, if there is one, how far `what` has come ("distance field of body 'bunny'"). It must
/// not outlive the work, in which it is also called with 1 at the end.
GoOn toldToListener(std::string what);

}  // namespace presa
