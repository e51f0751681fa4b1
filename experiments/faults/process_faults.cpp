#include <sched.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "experiments/faults/fault.h"
#include "experiments/faults/press.h"
#include "framework/core/schedule/clock.h"

namespace presa::faults {
namespace {

constexpr int kRuns = 100;            // runs take wall time
constexpr int kTries = 20;            // attempts to get one run with a known moment
constexpr double kSent = 0.5e-3;      // [s]: if it took longer until the program got a signal, its moment is unknown
constexpr double kHeldUp = 1e-3;      // [s]: the supervisor writes every 0.25 ms; a longer pause is the machine's
constexpr double kLoss = 20e-3;       // [s]: a supervisor that was not scheduled for this long counts as a lost device
constexpr double kSoftStart = 0.5;    // [s]
constexpr double kReturn = 2;         // [s]: max wait for the force after the program resumes
constexpr double kDetected = 6.5e-3;  // [s]: last command within a tick of the signal, held for 5 ms, then a late cycle
constexpr double kTick = 1e-3;        // [s]: a force may change by 1 N in this time

void sleepFor(double seconds) { sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(seconds * 1e9)); }
double secondsBetween(std::int64_t from, std::int64_t to) { return static_cast<double>(to - from) * 1e-9; }

/// A valid run, or the reason why it was discarded.
struct Try {
  std::optional<Outcome> outcome;
  std::string reason;
};

template <class... Numbers>
Try discarded(const char* pattern, Numbers... numbers) {
  std::array<char, 120> text;
  std::snprintf(text.data(), text.size(), pattern, numbers...);
  return {std::nullopt, text.data()};
}

/// Raises this thread's priority above the program's haptic thread and below the supervisor, so that sending a signal
/// is not preempted by the program and its moment is known.
class RealTimeMoment {
 public:
  RealTimeMoment() { schedule(SCHED_FIFO, kPriority); }
  ~RealTimeMoment() { schedule(SCHED_OTHER, 0); }
  RealTimeMoment(const RealTimeMoment&) = delete;
  RealTimeMoment& operator=(const RealTimeMoment&) = delete;

 private:
  static constexpr int kPriority = 83;
  static void schedule(int policy, int priority) {
    const sched_param wanted{.sched_priority = priority};
    sched_setscheduler(0, policy, &wanted);
  }
};

struct Sent {
  std::int64_t at_ns = 0;  ///< begin of the call
  double took = 0;         ///< until the last thread of a stopped program stood; until the call returned else [s]
};
Sent sendSignal(pid_t process, int signal) {
  const RealTimeMoment moment;
  const std::int64_t before = monotonicNs();
  kill(process, signal);
  if (signal == SIGSTOP) waitpid(process, nullptr, WUNTRACED);
  return {before, secondsBetween(before, monotonicNs())};
}

/// Longest time between two writes of the supervisor since `begin`, up to the entry `end` [s].
double longestPause(const ProbeLog& log, std::int64_t begin, std::uint64_t end) {
  double longest = 0;
  for (std::uint64_t i = 1; i < end; ++i) {
    if (log.entries[i].time_ns < begin) continue;
    longest = std::max(longest, secondsBetween(log.entries[i - 1].time_ns, log.entries[i].time_ns));
  }
  return longest;
}
double longestPause(const ProbeLog& log, std::int64_t begin) { return longestPause(log, begin, log.written); }

/// Result for a program that does not press: broken, unless the machine delayed the supervisor so long that it had to
/// count as lost.
Try notPressing(const PressingProgram& program) {
  if (const double pause = longestPause(program.log(), 0); pause > kLoss)
    return discarded("the machine held up the supervisor for %.1f ms before the fault", 1e3 * pause);
  Outcome outcome;
  outcome.broken.push_back(program.problem());
  return {outcome, {}};
}

/// Max change of the force per tick at the probe [N].
double steepest(const ProbeLog& log, std::uint64_t end) {
  double max = 0;
  for (std::uint64_t i = 1; i < end; ++i) {
    const double elapsed = secondsBetween(log.entries[i - 1].time_ns, log.entries[i].time_ns);
    max = std::max(max, log.entries[i].step * kTick / std::min(elapsed, kTick));
  }
  return max;
}

/// Judges the forces at the probe from `begin` up to the entry `end`.
Outcome judged(const ProbeLog& log, std::int64_t begin, std::uint64_t end) {
  Outcome outcome;
  outcome.detection = -1;
  outcome.step = steepest(log, end);
  bool forced = true;
  for (std::uint64_t i = 1; i < end; ++i) {
    const ProbeLog::Entry& entry = log.entries[i];
    if (entry.time_ns < begin) continue;
    const double since = secondsBetween(begin, entry.time_ns);
    if (outcome.detection < 0 && entry.force < 0.95 * PressingProgram::kForce) outcome.detection = since;
    if (forced || entry.force > 0) outcome.zero = since;  // ends at the first zero after the last force
    forced = entry.force > 0;
  }
  if (forced) outcome.broken.emplace_back("the force never became zero");
  return outcome;
}

/// Repeats a run until its moment is known; the discarded runs are reported with their reasons.
template <class Run>
Outcome tried(const Run& run) {
  std::vector<std::string> discarded;
  for (int i = 0; i < kTries; ++i) {
    Try one = run();
    if (one.outcome) {
      one.outcome->discarded = std::move(discarded);
      return *one.outcome;
    }
    discarded.push_back(std::move(one.reason));
  }
  Outcome outcome;
  outcome.broken.push_back("all 20 tries were discarded; the last: " + discarded.back());
  outcome.discarded = std::move(discarded);
  return outcome;
}

Outcome killed(RandomStream& random) {
  return tried([&]() -> Try {
    PressingProgram program;
    if (!program.problem().empty()) return notPressing(program);
    sleepFor(random.uniform(0, 0.05));
    const Sent sent = sendSignal(program.pid(), SIGKILL);
    const bool released = program.isReleased();
    if (sent.took > kSent) return discarded("SIGKILL took %.2f ms to send", 1e3 * sent.took);
    Outcome outcome = judged(program.log(), sent.at_ns, program.log().written);
    if (!released) outcome.broken.emplace_back("the supervisor did not end");
    return {outcome, {}};
  });
}

bool pushes(const ProbeLog& log) { return log.entries[log.written - 1].force > 0; }

/// Zero at first; after the program resumes, never above the ramp of a soft start.
void judgeReturn(const ProbeLog& log, std::int64_t resumed, Outcome& outcome) {
  bool first = true;
  for (std::uint64_t i = 0; i < log.written; ++i) {
    const ProbeLog::Entry& entry = log.entries[i];
    if (entry.time_ns < resumed) continue;
    if (first && entry.force > 0) outcome.broken.emplace_back("the first force after resuming was not zero");
    first = false;
    const double soft = PressingProgram::kForce * (secondsBetween(resumed, entry.time_ns) + 2e-3) / kSoftStart;
    if (entry.force > soft) outcome.broken.emplace_back("the force did not return softly");
  }
  outcome.step = steepest(log, log.written);
  if (!pushes(log)) outcome.broken.emplace_back("the force never returned");
}

Outcome stopped(RandomStream& random) {
  return tried([&]() -> Try {
    PressingProgram program;
    if (!program.problem().empty()) return notPressing(program);
    sleepFor(random.uniform(0, 0.05));
    const Sent sent = sendSignal(program.pid(), SIGSTOP);
    sleepFor(random.uniform(0.03, 0.3));
    const std::uint64_t end = program.log().written;
    const std::int64_t resumed = monotonicNs();
    kill(program.pid(), SIGCONT);
    sleepFor(0.1);
    if (sent.took > kSent) return discarded("the program took %.2f ms to stop", 1e3 * sent.took);
    // if the machine delayed the supervisor once more, wait for its restart
    while (!pushes(program.log()) && secondsBetween(resumed, monotonicNs()) < kReturn) sleepFor(0.01);
    Outcome outcome = judged(program.log(), sent.at_ns, end);
    if (const double pause = longestPause(program.log(), sent.at_ns, end); pause > kHeldUp)
      return discarded("the supervisor was held up for %.2f ms after the stop; zero after %.1f ms", 1e3 * pause,
                       1e3 * outcome.zero);
    if (const double pause = longestPause(program.log(), resumed); !pushes(program.log()) && pause > kLoss)
      return discarded("the machine held up the supervisor for %.1f ms after the return", 1e3 * pause);
    judgeReturn(program.log(), resumed, outcome);
    return {outcome, {}};
  });
}

}  // namespace

std::vector<Fault> processFaults() {
  return {
      {7,
       "program stopped (SIGSTOP) for 30 to 300 ms",
       "its supervisor takes the force to zero; back from zero, softly",
       {kDetected, kDetected + 0.004 + 2 * 0.25e-3, false},  // 4 N at 1 N/ms, one cycle to begin and one to be seen
       stopped,
       kRuns,
       true},
      {8,
       "program killed (SIGKILL) in the grasp",
       "its supervisor takes the force to zero, and lets go",
       {kDetected, 0.020, false},
       killed,
       kRuns,
       true},
  };
}

}  // namespace presa::faults
