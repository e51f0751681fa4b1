#include <gtest/gtest.h>

#include <filesystem>

#include "framework/session/session.h"
#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

// A session of a shipped scene, stepped by hand like the lockstep executor.
struct Stepped {
  explicit Stepped(const std::string& scene, const std::string& record = {}) {
    Diagnostics diagnostics;
    RunOptions options;
    options.record = record;
    options.realtime = true;  // the recorder must not wait
    Loaded loaded = loadWorld({test::source(scene), "", {}}, options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    rates = std::make_unique<RateTable>(loaded.world->scene.rates);
    session = std::make_unique<Session>(
        std::move(loaded), control,
        Session::Options{.trace_rate = 250, .devices = {}, .open_devices = true, .more = {}, .wrap = {}});
    for (const RateGroup group : {RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic})
      session->graph().start(group);
  }
  ~Stepped() {
    for (const RateGroup group : {RateGroup::kHaptic, RateGroup::kCollision, RateGroup::kDynamics})
      session->graph().stop(group);
    if (Recorder* recorder = session->recorder()) recorder->finish();
  }
  void slow(std::uint64_t i) {
    if (i % 5 == 0) session->graph().step(RateGroup::kDynamics, rates->tick(RateGroup::kDynamics, i / 5));
    if (i % 10 == 0) session->graph().step(RateGroup::kCollision, rates->tick(RateGroup::kCollision, i / 10));
  }
  void fast(std::uint64_t i) { session->graph().step(RateGroup::kHaptic, rates->tick(RateGroup::kHaptic, i)); }

  RunControl control;
  std::unique_ptr<RateTable> rates;
  std::unique_ptr<Session> session;
};

// Through reach, squeeze, lift, hold, slip and drop the whole haptic tick of two fingers (devices, rendering, output
// stages, monitor, recorder) allocates no memory, takes no lock, and makes no blocking call.
TEST(HapticTick, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  for (const char* scene : {"config/scenes/cube.xml", "config/scenes/pinch_and_lift.xml"}) {
    Stepped run(scene, test::scratch("rt.h5"));
    int violations = 0;
    const char* first = "";
    for (std::uint64_t i = 0; i < 10'000; ++i) {
      run.slow(i);
      const RealTimeGuard guard;
      run.fast(i);
      if (guard.violations() > 0 && violations == 0) first = guard.first();
      violations += guard.violations();
    }
    EXPECT_EQ(violations, 0) << scene << ": " << first;
    std::filesystem::remove(test::scratch("rt.h5"));
  }
}

// The same checked by the kernel: one second of held grasp in a process that dies at the first system call.
TEST(HapticTick, MakesNoSystemCall) {
  if (!syscallTrapWorks()) GTEST_SKIP() << "no system call filters here";
  for (const char* scene : {"config/scenes/cube.xml", "config/scenes/pinch_and_lift.xml"}) {
    Stepped run(scene);
    std::uint64_t i = 0;
    for (; i < 4000; ++i) {
      run.slow(i);
      run.fast(i);
    }
    EXPECT_EQ(runUnderSyscallTrap([&] {
                for (const std::uint64_t end = i + 1000; i < end; ++i) run.fast(i);
              }),
              "")
        << scene;
  }
}

}  // namespace
}  // namespace presa
