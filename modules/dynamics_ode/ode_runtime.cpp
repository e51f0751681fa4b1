#include "modules/dynamics_ode/ode_runtime.h"

#include <ode/ode.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace presa::ode {
namespace {

// ODE's handlers are global, but a world belongs to one thread: per-thread counters keep the worlds apart
thread_local std::uint64_t message_count = 0;
thread_local bool attached = false;

void countMessage(int, const char*, va_list) { ++message_count; }

// ODE ends the process when this handler returns, so it throws
[[noreturn]] void raiseFailure(int, const char* format, va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  throw OdeFailure(text.data());
}

void startOnce() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetMessageHandler(countMessage);
    dSetDebugHandler(raiseFailure);
    dSetErrorHandler(raiseFailure);
  });
  if (dCheckConfiguration("ODE_double_precision") != 1) {
    throw std::runtime_error(
        "the installed Open Dynamics Engine is a single-precision build; Presa needs libode in double precision");
  }
}

}  // namespace

void attachThread() {
  startOnce();
  if (attached) return;
  if (dAllocateODEDataForThread(dAllocateMaskAll) == 0) throw std::runtime_error("ODE: no memory for this thread");
  attached = true;
}

void detachThread() {
  if (attached) dCleanupODEAllDataForThread();
  attached = false;
}

std::uint64_t messageCount() noexcept { return message_count; }

}  // namespace presa::ode
