// The wall clock of this process jumps by an hour, back and forth, at every read: the functions below replace those of
// libc, also for the framework and every plug-in.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <ctime>

#include "experiments/faults/hold.h"
#include "experiments/faults/object_imports.h"
#include "framework/core/graph/graph_builder.h"
#include "framework/core/graph/port.h"
#include "framework/core/schedule/executor.h"
#include "framework/core/state/device_state.h"

namespace {

std::atomic<bool> jumping{false};
std::atomic<int> reads{0};
std::atomic<long> slept{0};  // simulated sleep of the machine, added to CLOCK_BOOTTIME [s]

void jump(timespec& now) {
  if (!jumping) return;
  now.tv_sec += (++reads % 2 == 0 ? 1 : -1) * 3600;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const long result = ::syscall(SYS_clock_gettime, clock, now);
  if (clock == CLOCK_BOOTTIME) now->tv_sec += slept;
  if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) jump(*now);
  return static_cast<int>(result);
}

extern "C" int gettimeofday(timeval* now, void*) noexcept {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  *now = {wall.tv_sec, wall.tv_nsec / 1000};
  return 0;
}

extern "C" time_t time(time_t* now) noexcept {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  if (now != nullptr) *now = wall.tv_sec;
  return wall.tv_sec;
}

namespace presa::faults {
namespace {

std::vector<Vec3> forces() {
  Hold hold;
  hold.end = 1.5;
  std::vector<Vec3> all;
  runHold(hold,
          [&](double, const Traffic& traffic) { all.insert(all.end(), traffic.force.begin(), traffic.force.end()); });
  return all;
}

TEST(WallClock, MayJumpAnHourAtEveryRead) {
  const std::vector<Vec3> steady = forces();
  jumping = true;
  const std::vector<Vec3> jumped = forces();
  const int read_by_run = reads;
  const auto before = std::chrono::system_clock::now(), after = std::chrono::system_clock::now();
  jumping = false;
  EXPECT_EQ(steady, jumped);
  EXPECT_EQ(read_by_run, 0);
  // the clock did jump
  EXPECT_GT(std::abs(std::chrono::duration<double>(after - before).count()), 3600);
}

/// Simulates a sleep of the machine for two seconds at its hundredth tick, which CLOCK_MONOTONIC does not count, and
/// counts the ticks that report a resume.
class Sleeper final : public Module {
 public:
  Sleeper() : Module("sleeper", RateGroup::kHaptic) {}
  void step(const Tick& tick) noexcept override {
    if (++ticks == kAsleepAt) slept = 2;
    if (tick.resumed) ++told, told_at = ticks;
  }
  static constexpr int kAsleepAt = 100;
  int ticks = 0, told = 0, told_at = 0;
  Out<DeviceState> state{*this, "device_state"};
};

// The machine sleeps while forces are applied. By the clock of the executor no tick is late, but the first tick after
// the sleep must still report it: the output stage latches on it (OutputStage, DeviceOutput).
TEST(Suspend, TheFirstTickAfterItSaysSo) {
  GraphBuilder builder;
  Sleeper& sleeper = builder.add(std::make_unique<Sleeper>());
  builder.connectByName();
  Graph graph = builder.build();
  RunControl control;
  const auto executor = makeExecutor(true, graph, RateTable(Rates{}), control);
  executor->run(0.3);
  slept = 0;
  EXPECT_EQ(sleeper.told, 1);
  EXPECT_EQ(sleeper.told_at, Sleeper::kAsleepAt + 1);
}

// The import check works: this program calls time(), and the framework imports clock_gettime.
TEST(WallClock, ImportsAreSeen) {
  EXPECT_EQ(wallClocksAmong({"clock_gettime", "time", "timegm", "gettimeofday"}),
            (std::vector<std::string>{"time", "gettimeofday"}));
  forces();  // loads the plug-ins
  bool framework = false;
  for (const ObjectImports& object : loadedObjects()) {
    if (object.name != "libpresa_framework.so") continue;
    framework = std::find(object.imports.begin(), object.imports.end(), "clock_gettime") != object.imports.end();
  }
  EXPECT_TRUE(framework);
}

}  // namespace
}  // namespace presa::faults
