#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>

#include "experiments/faults/press.h"
#include "framework/device/device_rating.h"
#include "framework/device/supervision/command_keeper.h"
#include "framework/session/realtime_rights.h"

// A whole program under the real supervisor, with its probe for a device, on files that lie; then the program is
// killed. The probe is rated for 10 N and 1 N/ms, and that is what it gets. Times are counted in the supervisor's
// cycles, of which each takes a quarter of a millisecond at least: a machine that is busy makes them longer, not more.
namespace presa {
namespace {

using faults::PressingProgram;
using faults::ProbeLog;

constexpr double kCycle = 0.25e-3, kGone = 20e-3;  // [s]
constexpr double kRate = 1000;                     // of the probe [N/s]

double secondsBetween(const ProbeLog::Entry& from, const ProbeLog::Entry& to) {
  return static_cast<double>(to.time_ns - from.time_ns) * 1e-9;
}

class LyingFiles : public testing::TestWithParam<PressingProgram::Limits> {};

TEST_P(LyingFiles, LeaveNoForceBehindAndMakeNoStep) {
  if (!realtimeRights().fifo.empty()) GTEST_SKIP() << "SCHED_FIFO: " << realtimeRights().fifo;
  const PressingProgram program(GetParam());
  ASSERT_EQ(program.problem(), "");
  const std::uint64_t then = program.log().written;
  kill(program.pid(), SIGKILL);
  ASSERT_TRUE(program.isReleased());
  const ProbeLog& log = program.log();
  std::uint64_t last = then;
  for (std::uint64_t i = 1; i < log.written; ++i) {
    const double elapsed = secondsBetween(log.entries[i - 1], log.entries[i]);
    ASSERT_LE(log.entries[i].step, kRate * std::min(elapsed, CommandKeeper::kLongestStep) * (1 + 1e-6) + 1e-12) << i;
    if (i >= then && log.entries[i].force > 0) last = i;
  }
  EXPECT_GT(last, then) << "it pressed";
  EXPECT_LE(static_cast<double>(last - then) * kCycle, kGone);
  EXPECT_EQ(log.entries[log.written - 1].force, 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, LyingFiles,
    testing::Values(PressingProgram::Limits{R"(force_rate="1e9")", ""},
                    PressingProgram::Limits{R"(force_rate="0.1")", ""},
                    PressingProgram::Limits{R"(watchdog_ms="1e9")", ""},
                    PressingProgram::Limits{R"(force="1e9" force_rate="1e9" watchdog_ms="1e9")",
                                            R"(force="1e9" force_rate="1e9" speed="1e9" continuous="1e9")"},
                    PressingProgram::Limits{"", R"(force_rate="0.1" speed="1e9" past_continuous="record")"}));

}  // namespace
}  // namespace presa
