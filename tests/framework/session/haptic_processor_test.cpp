// The processor that the haptic thread has to itself in real time.
#include "framework/session/haptic_processor.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "framework/session/realtime_rights.h"
#include "framework/session/run.h"

namespace presa {
namespace {

using Processors = std::set<int>;

/// Those on which a thread may run; 0: the calling thread.
Processors processorsOf(int thread) {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(thread, sizeof allowed, &allowed);
  Processors found;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &allowed)) found.insert(i);
  return found;
}

void bindCallerTo(const Processors& processors) {
  cpu_set_t wanted;
  CPU_ZERO(&wanted);
  for (const int i : processors) CPU_SET(i, &wanted);
  ASSERT_EQ(sched_setaffinity(0, sizeof wanted, &wanted), 0);
}

class HapticProcessorTest : public testing::Test {
 protected:
  void TearDown() override { EXPECT_EQ(processorsOf(0), before_); }

  /// Whether this machine can keep one; where it cannot, none may be kept.
  bool canKeepOne() const {
    if (before_.size() >= 2 && fifoRefusal().empty()) return true;
    EXPECT_EQ(HapticProcessor().number(), -1);
    return false;
  }

  /// Runs `attempt` until it is true: runs of other tests on this machine keep processors for a while.
  template <class Attempt>
  static bool within60Seconds(const Attempt& attempt) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      if (attempt()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  const Processors before_ = processorsOf(0);
};

TEST_F(HapticProcessorTest, IsKeptFromTheCallingThreadAndGivenBack) {
  if (!canKeepOne()) GTEST_SKIP() << "one processor only, or no SCHED_FIFO: none was kept";
  EXPECT_TRUE(within60Seconds([this] {
    const HapticProcessor kept;
    if (kept.number() < 0) return false;
    Processors others = before_;
    others.erase(kept.number());
    EXPECT_EQ(processorsOf(0), others);
    std::thread([&] {
      kept.bindCaller();
      EXPECT_EQ(processorsOf(0), Processors{kept.number()});
    }).join();
    return true;
  }));
}

TEST_F(HapticProcessorTest, IsAnotherOneForEachOfTwoRuns) {
  if (!canKeepOne()) GTEST_SKIP() << "one processor only, or no SCHED_FIFO: none was kept";
  EXPECT_TRUE(within60Seconds([this] {
    const HapticProcessor first;
    if (first.number() < 0) return false;
    bindCallerTo(before_);
    const HapticProcessor second;
    if (second.number() < 0) return false;
    EXPECT_NE(first.number(), second.number());
    return true;
  }));
}

TEST_F(HapticProcessorTest, IsNoneWhereThereIsOnlyOne) {
  bindCallerTo({*before_.begin()});
  {
    const HapticProcessor none;
    EXPECT_EQ(none.number(), -1);
    none.bindCaller();
    EXPECT_EQ(processorsOf(0), Processors{*before_.begin()});
  }
  bindCallerTo(before_);
}

/// By name, where every thread of a run may compute.
std::map<std::string, Processors> threadsOfThisProcess() {
  std::map<std::string, Processors> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string name;
    std::getline(std::ifstream(entry.path() / "comm"), name);
    found[name].merge(processorsOf(std::stoi(entry.path().filename())));
  }
  return found;
}

TEST_F(HapticProcessorTest, IsUsedByNoOtherThreadOfARun) {
  if (!canKeepOne()) GTEST_SKIP() << "one processor only, or no SCHED_FIFO: none was kept";
  EXPECT_TRUE(within60Seconds([] {
    RunControl control;
    Diagnostics diagnostics;
    Inputs inputs;
    inputs.scene = PRESA_SOURCE_DIR "/config/scenes/cube.xml";
    RunOptions options;
    options.realtime = true;
    options.duration = 0.2;
    presa::Run run(loadWorld(inputs, options, diagnostics), control);
    std::map<std::string, Processors> threads;
    run.onPoll([&] {
      if (threads.empty() && control.time > 0) threads = threadsOfThisProcess();
    });
    run.execute();
    const Processors haptic = threads["presa-haptic"];
    if (haptic.size() != 1) return false;  // other runs keep all processors
    EXPECT_TRUE(threads.contains("presa-dynamics"));
    for (const auto& [name, processors] : threads) {
      const bool other = name.starts_with("presa-") && name != "presa-haptic";
      EXPECT_FALSE(other && processors.contains(*haptic.begin())) << name;
    }
    EXPECT_FALSE(processorsOf(0).contains(*haptic.begin()));
    return true;
  }));
}

}  // namespace
}  // namespace presa
