// A guard that misses calls makes every test that uses it worthless: each trap must fire here.
#include "tests/support/alloc_lock_guard.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <mutex>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace presa {
namespace {

/// Keeps the optimiser from removing the tested call.
void keep(void* pointer) { asm volatile("" : : "g"(pointer) : "memory"); }

struct Forbidden {
  const char* name;   ///< function that must be reported first
  const char* title;  ///< of the test
  std::function<void()> call;
};
void PrintTo(const Forbidden& forbidden, std::ostream* out) { *out << forbidden.title; }

class EachTrap : public testing::TestWithParam<Forbidden> {
 protected:
  void SetUp() override {
    if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  }
};

TEST_P(EachTrap, FiresAndNamesTheFunction) {
  std::string first;
  int violations = 0;
  {
    RealTimeGuard guard;
    GetParam().call();
    violations = guard.violations();
    first = guard.first();
  }
  EXPECT_GE(violations, 1);
  EXPECT_EQ(first, GetParam().name);
}

void* block = nullptr;
void* given_back = std::malloc(1);  // each case may run in a separate process
pthread_mutex_t posix_mutex = PTHREAD_MUTEX_INITIALIZER;
pthread_rwlock_t rwlock = PTHREAD_RWLOCK_INITIALIZER;
std::mutex mutex;
std::condition_variable condition;
const timespec kNoTime{0, 0};

const std::vector<Forbidden> kForbidden{
    {"malloc", "Malloc", [] { keep(block = std::malloc(10)); }},
    {"realloc", "Realloc",
     [] {
       keep(block);
       block = std::realloc(block, 20);
     }},
    {"free", "Free", [] { std::free(std::exchange(given_back, nullptr)); }},
    {"calloc", "Calloc",
     [] {
       void* p = std::calloc(2, 5);
       keep(p);
       std::free(p);
     }},
    {"aligned_alloc", "AlignedAlloc",
     [] {
       void* p = std::aligned_alloc(64, 64);
       keep(p);
       std::free(p);
     }},
    {"posix_memalign", "PosixMemalign",
     [] {
       void* p = nullptr;
       if (posix_memalign(&p, 64, 64) == 0) std::free(p);
     }},
    {"malloc", "OperatorNew",
     [] {
       auto p = std::make_unique<int>(1);
       keep(p.get());
     }},
    {"malloc", "ArrayNew",
     [] {
       auto p = std::make_unique<double[]>(100);
       keep(p.get());
     }},
    {"aligned_alloc", "AlignedNew",
     [] {
       struct alignas(64) Line {
         char c[64];
       };
       auto p = std::make_unique<Line>();
       keep(p.get());
     }},
    {"malloc", "VectorGrowth",
     [] {
       std::vector<int> v;
       v.push_back(1);
       keep(v.data());
     }},
    {"malloc", "LongString",
     [] {
       std::string s(100, 'x');
       keep(s.data());
     }},
    {"malloc", "StdFunctionWithLargeCapture",
     [] {
       std::array<double, 8> big{};
       std::function<void()> f = [big] { keep(const_cast<double*>(big.data())); };
       f();
     }},
    {"malloc", "Throw",
     [] {
       try {
         throw std::logic_error("");
       } catch (const std::logic_error&) {
       }
     }},
    {"pthread_mutex_lock", "StdMutex", [] { std::lock_guard lock(mutex); }},
    {"pthread_mutex_trylock", "TryLock",
     [] {
       if (pthread_mutex_trylock(&posix_mutex) == 0) pthread_mutex_unlock(&posix_mutex);
     }},
    {"pthread_rwlock_rdlock", "ReadLock",
     [] {
       pthread_rwlock_rdlock(&rwlock);
       pthread_rwlock_unlock(&rwlock);
     }},
    {"pthread_rwlock_wrlock", "WriteLock",
     [] {
       pthread_rwlock_wrlock(&rwlock);
       pthread_rwlock_unlock(&rwlock);
     }},
    {"pthread_cond_signal", "NotifyOne", [] { condition.notify_one(); }},
    {"pthread_cond_broadcast", "NotifyAll", [] { condition.notify_all(); }},
    {"sem_wait", "Semaphore",
     [] {
       sem_t s;
       sem_init(&s, 0, 1);
       sem_wait(&s);
       sem_destroy(&s);
     }},
    {"open", "Open", [] { (void)open("/", O_RDONLY | O_DIRECTORY | O_CREAT, 0600); }},
    {"read", "Read",
     [] {
       char c;
       (void)!read(-1, &c, 1);
     }},
    {"write", "Write", [] { (void)!write(-1, "", 0); }},
    {"close", "Close", [] { close(-1); }},
    {"mmap", "MapMemory", [] { munmap(mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0), 4096); }},
    {"munmap", "UnmapMemory", [] { munmap(nullptr, 0); }},
    {"syscall", "Syscall", [] { syscall(SYS_getpid); }},
    {"usleep", "Usleep", [] { usleep(0); }},
    {"nanosleep", "Nanosleep", [] { nanosleep(&kNoTime, nullptr); }},
    {"clock_nanosleep", "ClockNanosleep", [] { clock_nanosleep(CLOCK_MONOTONIC, 0, &kNoTime, nullptr); }},
    {"fwrite", "StandardOutput", [] { std::clog << "a line from the guard's own test\n"
                                                << std::flush; }},
};

INSTANTIATE_TEST_SUITE_P(Guard, EachTrap, testing::ValuesIn(kForbidden),
                         [](const auto& parameter) { return std::string(parameter.param.title); });

// Permitted work of the haptic thread must pass.
TEST(Guard, LetsArithmeticClockAndAtomicsPass) {
  double sum = 0;
  std::array<double, 64> values{};
  int violations = 0;
  {
    RealTimeGuard guard;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
    for (double v : values) sum += v;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    violations = guard.violations();
  }
  EXPECT_EQ(violations, 0);
  EXPECT_TRUE(std::isfinite(sum));
}

// The guard ignores work on the same thread before and after its lifetime, and all work of other threads.
TEST(Guard, CountsOnlyItsOwnThreadAndLifetime) {
  std::vector<int> before(100);
  keep(before.data());
  int violations = -1;
  std::thread other;
  {
    std::atomic<bool> go{false}, done{false};
    other = std::thread([&] {
      while (!go) {
      }
      keep(std::make_unique<int>(1).get());
      done = true;
    });
    RealTimeGuard guard;
    go = true;
    while (!done) {
    }
    violations = guard.violations();
  }
  other.join();
  EXPECT_EQ(violations, 0);
}

// A nested guard must neither hide its findings from the outer guard nor count those made before its construction.
TEST(Guard, Nests) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  int outer_count = 0, inner_count = 0;
  std::string outer_first, inner_first;
  {
    RealTimeGuard outer;
    usleep(0);
    {
      RealTimeGuard inner;
      close(-1);
      inner_count = inner.violations();
      RealTimeGuard innermost;
      munmap(nullptr, 0);
    }
    outer_count = outer.violations();
    const char* name = outer.first();
    RealTimeGuard pause;
    outer_first = name;
  }
  {
    RealTimeGuard outer;
    {
      RealTimeGuard inner;
      close(-1);
    }
    inner_first = outer.first();
  }
  EXPECT_EQ(inner_count, 1);
  EXPECT_EQ(outer_count, 3);
  EXPECT_EQ(outer_first, "usleep");
  EXPECT_EQ(inner_first, "close");
}

// Interposition must not change the functions: a condition variable still works between threads.
TEST(Guard, LeavesTheFunctionsWorking) {
  bool ready = false;
  std::thread waker([&] {
    std::lock_guard lock(mutex);
    ready = true;
    condition.notify_one();
  });
  {
    std::unique_lock lock(mutex);
    condition.wait(lock, [&] { return ready; });
  }
  waker.join();
  EXPECT_TRUE(ready);
  EXPECT_EQ(syscall(SYS_getpid), getpid());
}

class SyscallTrap : public testing::Test {
 protected:
  void SetUp() override {
    if (!syscallTrapWorks()) GTEST_SKIP() << "no system call filter here";
  }
};

TEST_F(SyscallTrap, LetsPureComputationAndTheClockPass) {
  EXPECT_EQ(runUnderSyscallTrap([] {
              double sum = 0;
              for (int i = 0; i < 1000; ++i) sum += std::sqrt(i);
              keep(&sum);
              timespec now{};
              clock_gettime(CLOCK_MONOTONIC, &now);
              clock_nanosleep(CLOCK_MONOTONIC, 0, &kNoTime, nullptr);
            }),
            "");
}

TEST_F(SyscallTrap, CatchesEveryOtherCallByNumber) {
  EXPECT_EQ(runUnderSyscallTrap([] { getppid(); }), "system call " + std::to_string(SYS_getppid));
  EXPECT_EQ(runUnderSyscallTrap([] { (void)!write(2, "", 0); }),
            "system call " + std::to_string(SYS_write) + " (write)");
  EXPECT_EQ(runUnderSyscallTrap([] {
              char c;
              (void)!read(0, &c, 1);
            }),
            "system call " + std::to_string(SYS_read) + " (read)");
}

// glibc maps a block this large from the kernel: an internal call that the guard's interposition cannot see
TEST_F(SyscallTrap, CatchesCallsMadeInsideLibraries) {
  EXPECT_EQ(runUnderSyscallTrap([] { keep(std::malloc(std::size_t{1} << 28)); }),
            "system call " + std::to_string(SYS_mmap) + " (mmap)");
}

// The first throw of a process sets up the unwinder, which locks: throw once beforehand.
TEST_F(SyscallTrap, TellsHowElseTheFunctionEnded) {
  const auto throws = [] { throw std::logic_error(""); };
  EXPECT_THROW(throws(), std::logic_error);
  EXPECT_EQ(runUnderSyscallTrap(throws), "an exception");
  EXPECT_EQ(runUnderSyscallTrap([] { __builtin_trap(); }), "signal " + std::to_string(SIGILL));
}

}  // namespace
}  // namespace presa
