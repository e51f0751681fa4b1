#pragma once
#include <functional>
#include <string>

/// Two proofs that code may run in the haptic group. Link presa_test_support; both are off under the sanitizers, which
/// own the same functions (then a guard counts nothing, and the trap only runs the function).
namespace presa {

/// While it lives, counts what its thread must not do: allocate or free, lock or wait, sleep, map memory, open, read,
/// write. Sees calls from Presa, from plug-ins and from every library through their dynamic symbols; what a library
/// calls inside itself (the write of a printf) is for the system call trap below.
///
///     RealTimeGuard guard;
///     module.step(tick);
///     EXPECT_EQ(guard.violations(), 0) << guard.first();
///
/// Guards nest; each counts from its own start. Make and read it on one thread.
class RealTimeGuard {
 public:
  RealTimeGuard() noexcept;
  ~RealTimeGuard();
  RealTimeGuard(const RealTimeGuard&) = delete;
  RealTimeGuard& operator=(const RealTimeGuard&) = delete;

  /// Forbidden calls of this thread since the guard was made.
  int violations() const noexcept;
  /// Name of the first forbidden function, "" when there was none.
  const char* first() const noexcept;
  /// False under the sanitizers.
  static bool active() noexcept;

 private:
  int count_before_;
  const char* first_before_;
};

/// Runs `function` in a child process in which every system call but reading or awaiting the clock is caught by the
/// kernel (seccomp). "" when it made none, else the first one in words ("system call 1 (write)"), or how the child
/// ended. Warm up beforehand whatever does its set-up at the first call.
std::string runUnderSyscallTrap(const std::function<void()>& function);

/// False under the sanitizers and where the kernel refuses filters: then runUnderSyscallTrap proves nothing.
bool syscallTrapWorks();

}  // namespace presa
