#include <limits>

#include "experiments/faults/hold.h"
#include "experiments/faults/scene_faults.h"

namespace presa::faults {
namespace {

constexpr double kLimit = 8;       // of the scene [N]
constexpr double kReason = 1000;   // above this speed the dynamics freeze a body [m/s]
constexpr double kGravity = 9.81;  // [m/s^2]

std::string set(const std::string& path, double x, double y, double z) {
  return path + "=" + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z);
}

}  // namespace

/// A constant force accelerates a body far from the grasp beyond the speed limit of the dynamics.
Outcome bodyRunsAway(RandomStream& random) {
  const double begin = random.uniform(0.95, 2.6), mass = 1;
  Hold hold;
  hold.scene = "faults/stray.xml";
  hold.end = begin + 0.5;
  hold.sets = {set("body/stray/physics/force", 0, mass * kReason / begin, mass * kGravity)};
  Judge judge(begin, kForever);
  Outcome bounded;
  bool reported = false;
  runHold(
      hold,
      [&](double time, const Traffic& traffic) {
        judge.see(time, traffic);
        requireBounded(traffic, kLimit, bounded);
      },
      [&](StudyRun& run) { reported = (run.monitor().objectFaults() & kFaultBodyFrozen) != 0; });
  Outcome outcome = judge.outcome();
  outcome.broken.insert(outcome.broken.end(), bounded.broken.begin(), bounded.broken.end());
  if (!reported) outcome.broken.emplace_back("not reported");
  return outcome;
}

/// A body of 50 kg flies through the grasp.
Outcome bodyStruck(RandomStream& random) {
  const double arrives = random.uniform(0.95, 2.6), speed = random.uniform(3, 25), mass = 50;
  Hold hold;
  hold.scene = "faults/stray.xml";
  hold.end = arrives + 0.3;
  hold.sets = {"body/stray/physics/mass=" + std::to_string(mass),
               set("body/stray/physics/force", 0, 0, mass * kGravity),
               set("body/stray/pos", random.uniform(-0.05, 0.05), -speed * arrives, 0.12),
               set("body/stray/velocity", 0, speed, 0)};
  Outcome outcome;
  runHold(hold, [&](double, const Traffic& traffic) {
    requireBounded(traffic, kLimit, outcome);
    outcome.step = traffic.step;
  });
  return outcome;
}

/// A tall stack with a heavy lid sometimes needs more than the dynamics period: every third tick on average is late.
Outcome overloadedDynamics(RandomStream& random) {
  RandomStream lateness(random.bits(), "lateness");
  Hold hold;
  hold.scene = "faults/stack.xml";
  hold.end = 1.3;
  std::uint64_t held = 0;
  hold.held_up = [&](RateGroup group, double) {
    const bool late = group == RateGroup::kDynamics && lateness.below(3) == 0;
    held += late ? 1 : 0;
    return late;
  };
  Outcome outcome;
  std::uint64_t ticks = 0;
  const auto requireRates = [&](StudyRun& run) {
    const GroupTiming& haptic = run.timing(RateGroup::kHaptic);
    const auto wanted = RateTable(run.world().scene.rates).ticksWithin(RateGroup::kHaptic, hold.end);
    if (ticks != wanted || haptic.ticks != wanted || haptic.missed != 0 || haptic.skipped != 0)
      outcome.broken.emplace_back("haptic ticks were lost");
    if (held == 0 || run.timing(RateGroup::kDynamics).missed == 0)
      outcome.broken.emplace_back("no dynamics tick was late");
  };
  runHold(
      hold,
      [&](double, const Traffic& traffic) {
        ++ticks;
        requireBounded(traffic, kLimit, outcome);
        outcome.step = traffic.step;
      },
      requireRates);
  return outcome;
}

}  // namespace presa::faults
