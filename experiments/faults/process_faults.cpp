#include <sched.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "experiments/faults/fault.h"
#include "experiments/faults/press.h"
#include "experiments/faults/witness.h"
#include "framework/core/schedule/clock.h"

namespace presa::faults {
namespace {

constexpr int kRuns = 100;            // runs take wall time
constexpr int kTries = 20;            // attempts to start a program that presses
constexpr double kSoftStart = 0.5;    // [s]
constexpr double kReturn = 8;         // [s]: max wait for the force after the program resumes
constexpr double kDetected = 6.5e-3;  // [s]: last command within a tick of the signal, held for 5 ms, then a late cycle
constexpr double kTick = 1e-3;        // [s]: a force may change by 1 N in this time

void sleepFor(double seconds) { sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(seconds * 1e9)); }
double secondsBetween(std::int64_t from, std::int64_t to) { return static_cast<double>(to - from) * 1e-9; }

std::string text(const char* pattern, auto... numbers) {
  std::array<char, 160> line;
  std::snprintf(line.data(), line.size(), pattern, numbers...);
  return line.data();
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

/// Time within [begin, begin + duration] in which neither the supervisor wrote nor a witness ran [s].
double heldUp(const ProbeLog& log, const Witness& witness, std::int64_t begin, double duration) {
  const std::int64_t end = begin + static_cast<std::int64_t>(duration * 1e9);
  constexpr auto kDue = static_cast<std::int64_t>(Witness::kPeriod * 1e9);
  double sum = 0;
  for (std::uint64_t i = 1; i < log.written; ++i) {
    const std::int64_t from = log.entries[i - 1].time_ns, to = log.entries[i].time_ns;
    if (secondsBetween(from, to) > Witness::kGap)
      sum += witness.heldUp(std::max(from + kDue, begin), std::min(to, end));
  }
  return sum;
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

/// Makes the bounds longer by what the machine did, and says so where the run needs it.
void excuse(const ProbeLog& log, const Witness& witness, const Sent& sent, const Bounds& bounds, Outcome& outcome) {
  outcome.held_up_detection = sent.took + heldUp(log, witness, sent.at_ns, std::max(0.0, outcome.detection));
  outcome.held_up_zero = sent.took + heldUp(log, witness, sent.at_ns, outcome.zero);
  if (outcome.detection <= bounds.detection && outcome.zero <= bounds.zero) return;
  outcome.delayed = text(
      "detected after %.1f ms, zero after %.1f ms; the machine ran nobody for %.1f ms of them, and the signal took "
      "%.2f ms",
      1e3 * outcome.detection, 1e3 * outcome.zero, 1e3 * (outcome.held_up_zero - sent.took), 1e3 * sent.took);
}

/// Whether the finger pressed without a break until the signal came. On a machine that holds up a thread of the program
/// the
/// output stage may have taken the force away before: then there is no grasp to fail, or the supervisor has already had
/// the moment for which a stall is meant.
bool pressedAt(const ProbeLog& log, std::int64_t at_ns) {
  bool pressed = false;
  for (std::uint64_t i = 0; i < log.written && log.entries[i].time_ns < at_ns; ++i) {
    const double force = log.entries[i].force;
    if (pressed && force < 0.95 * PressingProgram::kForce) return false;
    pressed = pressed || force > 0.99 * PressingProgram::kForce;
  }
  return pressed;
}

/// Runs `fault` on a program that presses; none if it pressed no more when the fault came. The program is a child of
/// this
/// one in half of the runs, and `presa` itself in the others. A program that does not press is started again: nothing
/// of it is judged here, and the report lists it.
template <class Run>
Outcome onPressing(RandomStream& random, double stall, const Run& fault) {
  const bool presa = random.uniform(0, 1) < 0.5;
  std::vector<std::string> not_started;
  for (int i = 0; i < kTries; ++i) {
    PressingProgram program({.stall = stall, .presa = presa});
    if (!program.problem().empty()) {
      const double pause = longestPause(program.log(), 0);
      not_started.push_back(pause > PressingProgram::kLoss
                                ? text("the machine held up the supervisor for %.1f ms before the fault", 1e3 * pause)
                                : program.problem());
      continue;
    }
    std::optional<Outcome> outcome = fault(program);
    if (!outcome) {
      not_started.emplace_back("the program let go before the fault");
      continue;
    }
    outcome->not_started = std::move(not_started);
    return *outcome;
  }
  Outcome outcome;
  outcome.broken.push_back("the program did not press in 20 tries; the last: " + not_started.back());
  outcome.not_started = std::move(not_started);
  return outcome;
}

constexpr Bounds kKilled{kDetected, 0.020, false};
// 4 N at 1 N/ms, one cycle to begin and one to be seen
constexpr Bounds kStopped{kDetected, kDetected + 0.004 + 2 * 0.25e-3, false};

Outcome killed(RandomStream& random, double stall) {
  return onPressing(random, stall, [&](PressingProgram& program) -> std::optional<Outcome> {
    Witness witness;
    sleepFor(random.uniform(0, 0.05));
    const Sent sent = sendSignal(program.pid(), SIGKILL);
    const bool released = program.isReleased();
    witness.stop();
    if (!pressedAt(program.log(), sent.at_ns)) return std::nullopt;
    Outcome outcome = judged(program.log(), sent.at_ns, program.log().written);
    excuse(program.log(), witness, sent, kKilled, outcome);
    if (!released) outcome.broken.emplace_back("the supervisor did not end");
    return outcome;
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
  // a supervisor that was held up for long on the way back holds its device for lost
  if (!pushes(log) && longestPause(log, resumed) <= PressingProgram::kLoss)
    outcome.broken.emplace_back("the force never returned");
}

Outcome stopped(RandomStream& random, double stall) {
  return onPressing(random, stall, [&](PressingProgram& program) -> std::optional<Outcome> {
    Witness witness;
    sleepFor(random.uniform(0, 0.05));
    const Sent sent = sendSignal(program.pid(), SIGSTOP);
    sleepFor(random.uniform(0.03, 0.3));
    witness.stop();
    if (!pressedAt(program.log(), sent.at_ns)) return std::nullopt;
    const std::uint64_t end = program.log().written;
    const std::int64_t resumed = monotonicNs();
    kill(program.pid(), SIGCONT);
    sleepFor(0.1);
    // if the machine delayed the supervisor once more, wait for its restart
    while (!pushes(program.log()) && secondsBetween(resumed, monotonicNs()) < kReturn) sleepFor(0.01);
    Outcome outcome = judged(program.log(), sent.at_ns, end);
    excuse(program.log(), witness, sent, kStopped, outcome);
    judgeReturn(program.log(), resumed, outcome);
    return outcome;
  });
}

}  // namespace

std::vector<Fault> processFaults(double stall) {
  return {
      {7, "program stopped (SIGSTOP) for 30 to 300 ms",
       "its supervisor takes the force to zero; back from zero, softly", kStopped,
       [stall](RandomStream& random) { return stopped(random, stall); }, kRuns, true},
      {8, "program killed (SIGKILL) in the grasp", "its supervisor takes the force to zero, and lets go", kKilled,
       [stall](RandomStream& random) { return killed(random, stall); }, kRuns, true},
  };
}

}  // namespace presa::faults
