#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/faults/fault.h"
#include "experiments/faults/press.h"
#include "framework/schedule/clock.h"

namespace presa::faults {
namespace {

constexpr int kRuns = 100;            // each takes its time
constexpr int kTries = 20;            // for one run without somebody else's pause in it
constexpr double kPause = 0.5e-3;     // what comes so late was not let run [s]
constexpr double kStanding = 0.3e-3;  // a program told to stop stands by then, or its moment is not known [s]
constexpr double kLoss = 20e-3;       // a supervisor that was not let run for so long is a lost device [s]
constexpr double kSoftStart = 0.5;    // [s]
constexpr double kReturn = 2;         // patience for the force after the program's return [s]
constexpr double kCyclesPerTick = 4;

void sleepFor(double seconds) { sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(seconds * 1e9)); }
double secondsBetween(std::int64_t from, std::int64_t to) { return static_cast<double>(to - from) * 1e-9; }

/// All its threads stand still, a moment after they were told to; false: that took the machine longer.
bool standsStill(pid_t process, std::int64_t told) {
  while (secondsBetween(told, monotonicNs()) < kStanding) {
    int status = 0;
    if (waitpid(process, &status, WUNTRACED | WNOHANG) == process) return WIFSTOPPED(status);
  }
  return false;
}

/// Sends the signal; when it was sent [ns], or nothing when the one who sends was interrupted himself.
std::optional<std::int64_t> signalled(pid_t process, int signal) {
  const std::int64_t before = monotonicNs();
  kill(process, signal);
  const std::int64_t after = monotonicNs();
  if (secondsBetween(before, after) > kPause) return std::nullopt;
  return before;
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

/// A program that does not press: nothing when the machine held up its supervisor so long that it had to be taken for lost.
std::optional<Outcome> notPressing(const PressingProgram& program) {
  if (longestPause(program.log(), 0) > kLoss) return std::nullopt;
  Outcome outcome;
  outcome.broken.push_back(program.problem());
  return outcome;
}

/// What reached the probe since `begin`, up to the entry `end`. Nothing when the machine did not let the supervisor run.
std::optional<Outcome> judged(const ProbeLog& log, std::int64_t begin, std::uint64_t end) {
  Outcome outcome;
  outcome.detection = -1;
  std::int64_t before = begin;
  double last_force_at = 0;
  for (std::uint64_t i = 1; i < end; ++i) {
    const ProbeLog::Entry& entry = log.entries[i];
    outcome.step = std::max(outcome.step, kCyclesPerTick * entry.step);
    if (entry.time_ns < begin) continue;
    const double since = secondsBetween(begin, entry.time_ns);
    if (secondsBetween(before, entry.time_ns) > kPause && last_force_at >= 0 && entry.force > 0) return std::nullopt;
    before = entry.time_ns;
    if (outcome.detection < 0 && entry.force < 0.95 * PressingProgram::kForce) outcome.detection = since;
    if (entry.force > 0) last_force_at = since;
  }
  outcome.zero = last_force_at + 0.25e-3;  // the write after the last that was not zero
  return outcome;
}

/// Until the machine lets a run be seen as it is.
template <class Run>
Outcome tried(const Run& run) {
  for (int i = 0; i < kTries; ++i) {
    if (const std::optional<Outcome> outcome = run()) return *outcome;
  }
  Outcome outcome;
  outcome.broken.emplace_back("the machine paused the supervisor in every one of 20 tries");
  return outcome;
}

Outcome killed(RandomStream& random) {
  return tried([&]() -> std::optional<Outcome> {
    PressingProgram program;
    if (!program.problem().empty()) return notPressing(program);
    sleepFor(random.uniform(0, 0.05));
    const auto begin = signalled(program.pid(), SIGKILL);
    const bool released = program.isReleased();
    if (!begin) return std::nullopt;
    auto outcome = judged(program.log(), *begin, program.log().written);
    if (outcome && !released) outcome->broken.emplace_back("the supervisor stayed");
    return outcome;
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
    outcome.step = std::max(outcome.step, kCyclesPerTick * entry.step);
  }
  if (!pushes(log)) outcome.broken.emplace_back("the force never came back");
}

Outcome stopped(RandomStream& random) {
  return tried([&]() -> std::optional<Outcome> {
    PressingProgram program;
    if (!program.problem().empty()) return notPressing(program);
    sleepFor(random.uniform(0, 0.05));
    const auto begin = signalled(program.pid(), SIGSTOP);
    const bool stands = begin && standsStill(program.pid(), *begin);
    sleepFor(random.uniform(0.03, 0.3));
    const std::uint64_t end = program.log().written;
    const std::int64_t resumed = monotonicNs();
    kill(program.pid(), SIGCONT);
    sleepFor(0.1);
    if (!stands) return std::nullopt;
    // a program that the machine holds up once more starts anew
    while (!pushes(program.log()) && secondsBetween(resumed, monotonicNs()) < kReturn) sleepFor(0.01);
    auto outcome = judged(program.log(), *begin, end);
    if (!pushes(program.log()) && longestPause(program.log(), resumed) > kLoss) return std::nullopt;
    if (outcome) judgeReturn(program.log(), resumed, *outcome);
    return outcome;
  });
}

}  // namespace

std::vector<Fault> processFaults() {
  return {
      {7,
       "program stopped (SIGSTOP) for 30 to 300 ms",
       "its supervisor takes the force to zero; back from zero, softly",
       {0.0065, 0.010, false},
       stopped,
       kRuns,
       true},
      {8,
       "program killed (SIGKILL) in the grasp",
       "its supervisor takes the force to zero, and lets go",
       {0.0065, 0.020, false},
       killed,
       kRuns,
       true},
  };
}

}  // namespace presa::faults
