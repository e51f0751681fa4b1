#pragma once
#include <functional>
#include <string>

/// Two proofs that code may run in the haptic group. Link presa_test_support; both are off under the sanitizers, which
/// own the same functions (then a guard counts nothing, and the trap only runs the function).
namespace presa {

/// During its lifetime, counts the forbidden calls of its thread: allocate or free, lock or wait, sleep, map memory,
/// open, read, write. It sees calls from Presa, plug-ins and libraries through dynamic symbols; internal calls of a
/// library (the write of a printf) are left to the system call trap below.
///
///     RealTimeGuard guard;
///     module.step(tick);
///     EXPECT_EQ(guard.violations(), 0) << guard.first();
///
/// Guards nest; each counts from its own construction. Construct and read a guard on one thread.
class RealTimeGuard {
 public:
  RealTimeGuard() noexcept;  ///< from now on calls count
  ~RealTimeGuard();          ///< to here
  RealTimeGuard(const RealTimeGuard&) = delete;
  RealTimeGuard& operator=(const RealTimeGuard&) = delete;

  /// Forbidden calls of this thread since the guard's construction.
  int violations() const noexcept;
  /// Name of the first forbidden function; "": none.
  const char* first() const noexcept;
  /// False under the sanitizers.
  static bool active() noexcept;

 private:
  int count_before_;
  const char* first_before_;
};

/// Runs `function` in a child process in which the kernel (seccomp) traps every system call except reading or awaiting
/// the clock. Returns "" when there was none, otherwise the first one as text ("system call 1 (write)"), or how the
/// child ended. Warm up code beforehand that does set-up at its first call.
std::string runUnderSyscallTrap(const std::function<void()>& function);

/// False under the sanitizers and where the kernel refuses filters: runUnderSyscallTrap() proves nothing then.
bool syscallTrapWorks();

}  // namespace presa
