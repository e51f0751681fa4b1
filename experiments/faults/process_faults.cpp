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

constexpr int kRuns = 100;            // each takes its time
constexpr int kTries = 20;            // for one run whose moment is known
constexpr double kSent = 0.5e-3;      // a signal that took longer to send: nobody knows when it came [s]
constexpr double kLoss = 20e-3;       // a supervisor that was not let run for so long is a lost device [s]
constexpr double kSoftStart = 0.5;    // [s]
constexpr double kReturn = 2;         // patience for the force after the program's return [s]
constexpr double kDetected = 6.5e-3;  // a last command within a tick of the signal, held for 5 ms, and a late cycle [s]
constexpr double kTick = 1e-3;        // in which a force may change by 1 N [s]

void sleepFor(double seconds) { sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(seconds * 1e9)); }
double secondsBetween(std::int64_t from, std::int64_t to) { return static_cast<double>(to - from) * 1e-9; }

/// A run that counts, or why there was none.
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

/// While it lives, nothing but the supervisor comes between: below its priority, above the program's haptic thread. So the moment of a
/// signal is known, and hardly a run is lost.
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
  double took = 0;         ///< [s]
};
Sent sendSignal(pid_t process, int signal) {
  const RealTimeMoment moment;
  const std::int64_t before = monotonicNs();
  kill(process, signal);
  return {before, secondsBetween(before, monotonicNs())};
}

/// Longest time between two writes of the supervisor since `begin` [s].
double longestPause(const ProbeLog& log, std::int64_t begin) {
  double longest = 0;
  for (std::uint64_t i = 1; i < log.written; ++i) {
    if (log.entries[i].time_ns < begin) continue;
    longest = std::max(longest, secondsBetween(log.entries[i - 1].time_ns, log.entries[i].time_ns));
  }
  return longest;
}

/// A program that does not press: its own fault, unless the machine held up its supervisor so long that it had to be taken for lost.
Try notPressing(const PressingProgram& program) {
  if (const double pause = longestPause(program.log(), 0); pause > kLoss)
    return discarded("the machine held up the supervisor for %.1f ms before the fault", 1e3 * pause);
  Outcome outcome;
  outcome.broken.push_back(program.problem());
  return {outcome, {}};
}

/// The fastest change per tick of what reached the probe [N].
double steepest(const ProbeLog& log, std::uint64_t end) {
  double most = 0;
  for (std::uint64_t i = 1; i < end; ++i) {
    const double elapsed = secondsBetween(log.entries[i - 1].time_ns, log.entries[i].time_ns);
    most = std::max(most, log.entries[i].step * kTick / std::min(elapsed, kTick));
  }
  return most;
}

/// What reached the probe since `begin`, up to the entry `end`.
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
  if (forced) outcome.broken.emplace_back("the force never went");
  return outcome;
}

/// Every run counts, but one of which nobody can tell when its fault came; those are told with their figures.
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
  outcome.broken.push_back("none of 20 tries counts; the last: " + discarded.back());
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
    if (!released) outcome.broken.emplace_back("the supervisor stayed");
    return {outcome, {}};
  });
}

bool pushes(const ProbeLog& log) { return log.entries[log.written - 1].force > 0; }

/// First zero; from the program's return on never more than a soft start from there allows.
void judgeReturn(const ProbeLog& log, std::int64_t resumed, Outcome& outcome) {
  bool first = true;
  for (std::uint64_t i = 0; i < log.written; ++i) {
    const ProbeLog::Entry& entry = log.entries[i];
    if (entry.time_ns < resumed) continue;
    if (first && entry.force > 0) outcome.broken.emplace_back("the first force after the return was not zero");
    first = false;
    const double soft = PressingProgram::kForce * (secondsBetween(resumed, entry.time_ns) + 2e-3) / kSoftStart;
    if (entry.force > soft) outcome.broken.emplace_back("the force did not come back softly");
  }
  outcome.step = steepest(log, log.written);
  if (!pushes(log)) outcome.broken.emplace_back("the force never came back");
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
    if (sent.took > kSent) return discarded("SIGSTOP took %.2f ms to send", 1e3 * sent.took);
    // a program that the machine holds up once more starts anew
    while (!pushes(program.log()) && secondsBetween(resumed, monotonicNs()) < kReturn) sleepFor(0.01);
    Outcome outcome = judged(program.log(), sent.at_ns, end);
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
       {kDetected, kDetected + 0.004 + 2 * 0.25e-3, false},  // 4 N at 1 N/ms, a cycle to begin and one to be seen
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
