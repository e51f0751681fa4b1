#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

struct ThreadState {
  int guards = 0;
  int count = 0;
  const char* first = "";
};
// plain data of the program: access never allocates
constinit thread_local ThreadState state;

}  // namespace

RealTimeGuard::RealTimeGuard() noexcept : count_before_(state.count), first_before_(state.first) {
  state.first = "";
  ++state.guards;
}

RealTimeGuard::~RealTimeGuard() {
  --state.guards;
  // an enclosing guard keeps its own first finding
  if (*first_before_ != '\0' || state.guards == 0) state.first = first_before_;
}

int RealTimeGuard::violations() const noexcept { return state.count - count_before_; }

const char* RealTimeGuard::first() const noexcept { return state.first; }

#ifdef PRESA_SANITIZE

bool RealTimeGuard::active() noexcept { return false; }

}  // namespace presa

#else

bool RealTimeGuard::active() noexcept { return true; }

namespace {

void note(const char* function) noexcept {
  if (state.guards == 0) return;
  if (*state.first == '\0') state.first = function;
  ++state.count;
}

}  // namespace
}  // namespace presa

// ---- interposed functions of libc: the dynamic linker finds these first, for the program and every library ----------

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace {

/// The interposed function of libc. It is looked up at the first call, which may come before any static constructor has
/// run; a simultaneous lookup by two threads is harmless.
template <class Function>
class Original {
 public:
  constexpr explicit Original(const char* name) : name_(name) {}
  template <class... Arguments>
  auto operator()(Arguments... arguments) {
    Function* function = function_.load(std::memory_order_relaxed);
    if (function == nullptr) {
      function = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name_));
      function_.store(function, std::memory_order_relaxed);
    }
    return function(arguments...);
  }

 private:
  const char* name_;
  std::atomic<Function*> function_{nullptr};
};

mode_t modeOf(int flags, va_list arguments) {
  // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): both callers start the list
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : mode_t{0};
}

}  // namespace

extern "C" {

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
// glibc's allocator under its internal names: dlsym, which allocates, cannot be used to find it
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t size) noexcept {
  presa::note("malloc");
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  presa::note("calloc");
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  presa::note("realloc");
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  presa::note("aligned_alloc");
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  presa::note("posix_memalign");
  *memory = __libc_memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}
void free(void* memory) noexcept {
  if (memory != nullptr) presa::note("free");
  __libc_free(memory);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  static constinit Original<int(pthread_mutex_t*)> original("pthread_mutex_lock");
  presa::note("pthread_mutex_lock");
  return original(mutex);
}
int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  static constinit Original<int(pthread_mutex_t*)> original("pthread_mutex_trylock");
  presa::note("pthread_mutex_trylock");
  return original(mutex);
}
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept {
  static constinit Original<int(pthread_rwlock_t*)> original("pthread_rwlock_rdlock");
  presa::note("pthread_rwlock_rdlock");
  return original(lock);
}
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept {
  static constinit Original<int(pthread_rwlock_t*)> original("pthread_rwlock_wrlock");
  presa::note("pthread_rwlock_wrlock");
  return original(lock);
}
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  static constinit Original<int(pthread_cond_t*, pthread_mutex_t*)> original("pthread_cond_wait");
  presa::note("pthread_cond_wait");
  return original(condition, mutex);
}
int pthread_cond_signal(pthread_cond_t* condition) noexcept {
  static constinit Original<int(pthread_cond_t*)> original("pthread_cond_signal");
  presa::note("pthread_cond_signal");
  return original(condition);
}
int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
  static constinit Original<int(pthread_cond_t*)> original("pthread_cond_broadcast");
  presa::note("pthread_cond_broadcast");
  return original(condition);
}
int sem_wait(sem_t* semaphore) {
  static constinit Original<int(sem_t*)> original("sem_wait");
  presa::note("sem_wait");
  return original(semaphore);
}

ssize_t read(int file, void* data, std::size_t size) {
  static constinit Original<ssize_t(int, void*, std::size_t)> original("read");
  presa::note("read");
  return original(file, data, size);
}
ssize_t write(int file, const void* data, std::size_t size) {
  static constinit Original<ssize_t(int, const void*, std::size_t)> original("write");
  presa::note("write");
  return original(file, data, size);
}
std::size_t fwrite(const void* data, std::size_t size, std::size_t count, FILE* file) {
  static constinit Original<std::size_t(const void*, std::size_t, std::size_t, FILE*)> original("fwrite");
  presa::note("fwrite");
  return original(data, size, count, file);
}
int open(const char* path, int flags, ...) {
  static constinit Original<int(const char*, int, ...)> original("open");
  presa::note("open");
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = modeOf(flags, arguments);
  va_end(arguments);
  return original(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  static constinit Original<int(const char*, int, ...)> original("open64");
  presa::note("open64");
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = modeOf(flags, arguments);
  va_end(arguments);
  return original(path, flags, mode);
}
int close(int file) {
  static constinit Original<int(int)> original("close");
  presa::note("close");
  return original(file);
}
void* mmap(void* address, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  static constinit Original<void*(void*, std::size_t, int, int, int, off_t)> original("mmap");
  presa::note("mmap");
  return original(address, size, protection, flags, file, offset);
}
int munmap(void* address, std::size_t size) noexcept {
  static constinit Original<int(void*, std::size_t)> original("munmap");
  presa::note("munmap");
  return original(address, size);
}
// std::atomic::wait and latches call the futex through this function
long syscall(long number, ...) noexcept {
  static constinit Original<long(long, ...)> original("syscall");
  presa::note("syscall");
  va_list arguments;
  va_start(arguments, number);
  long value[6];
  for (long& argument : value) argument = va_arg(arguments, long);
  va_end(arguments);
  return original(number, value[0], value[1], value[2], value[3], value[4], value[5]);
}

int usleep(useconds_t time) {
  static constinit Original<int(useconds_t)> original("usleep");
  presa::note("usleep");
  return original(time);
}
int nanosleep(const timespec* time, timespec* left) {
  static constinit Original<int(const timespec*, timespec*)> original("nanosleep");
  presa::note("nanosleep");
  return original(time, left);
}
int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  static constinit Original<int(clockid_t, int, const timespec*, timespec*)> original("clock_nanosleep");
  presa::note("clock_nanosleep");
  return original(clock, flags, time, left);
}

}  // extern "C"

#endif
