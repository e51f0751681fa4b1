#include <limits>

#include "experiments/faults/hold.h"
#include "experiments/faults/object_imports.h"
#include "experiments/faults/scene_faults.h"
#include "framework/session/realtime_policy.h"

namespace presa::faults {
namespace {

constexpr double kReducedLimit = 3;  // reduced limit of the scene, below the force of the grasp [N]

/// All forces of a complete hold.
std::vector<Vec3> forcesOf(double end) {
  Hold hold;
  hold.end = end;
  std::vector<Vec3> forces;
  runHold(hold, [&](double, const Traffic& traffic) {
    forces.insert(forces.end(), traffic.force.begin(), traffic.force.end());
  });
  return forces;
}

}  // namespace

/// Code that does not read the wall clock cannot be affected by it: no loaded object imports a wall-clock function.
/// Exceptions, outside every tick: the recording notes its start time, and the program dates its results.
/// tests/experiments/faults makes the clock actually jump.
Outcome wallClockJumps(RandomStream& random) {
  Outcome outcome;
  const double end = random.uniform(1, 1.5);
  if (forcesOf(end) != forcesOf(end)) outcome.broken.emplace_back("two equal runs differ");
  const std::vector<ObjectImports> objects = loadedObjects();
  if (objects.size() < 4) outcome.broken.emplace_back("no loaded objects were found");
  for (const ObjectImports& object : objects) {
    if (object.name == "presa_record.so") continue;
    for (const std::string& clock : wallClocksAmong(object.imports))
      outcome.broken.push_back(object.name + " reads the wall clock: " + clock);
  }
  return outcome;
}

/// The process is stopped, or the machine sleeps, during the grasp. Afterwards the force stays zero until a re-arm,
/// then rises softly.
Outcome standsStill(RandomStream& random) {
  // not during the lift: the hand would leave the object behind, and no force could return
  const double begin = random.uniform(1.85, 2.6), end = begin + random.uniform(2, 20), rearm = end + 0.2;
  Hold hold;
  hold.end = rearm + 0.8;
  hold.rearm = rearm;
  hold.held_up = [=](RateGroup, double time) { return time >= begin - 1e-9 && time < end - 1e-9; };
  Outcome outcome;
  double held = 0, first = -1, latched = 0, come_back = 0, last = 0, rise = 0;
  runHold(hold, [&](double time, const Traffic& traffic) {
    requireBounded(traffic, kHoldLimit, outcome);
    const double now = std::max(traffic.force[0].norm(), traffic.force[1].norm());
    if (time < begin - 1e-9) {
      held = now;
      outcome.step = traffic.step;  // measured before the gap, which lasts many seconds
    } else if (first < 0) {
      first = now;
    } else if (time < rearm) {
      latched = std::max(latched, now);
    } else {
      rise = std::max(rise, now - last);
      come_back = std::max(come_back, now);
    }
    last = now;
  });
  if (held < 0.5) outcome.broken.emplace_back("nothing was held before the standstill");
  if (first != 0) outcome.broken.emplace_back("the first force after the standstill was not zero");
  if (latched != 0) outcome.broken.emplace_back("a force came back without a re-arm");
  if (!(come_back > 0.5)) outcome.broken.emplace_back("no force came back after the re-arm");
  if (rise > 1 + 1e-9) outcome.broken.emplace_back("a force step after the re-arm");
  return outcome;
}

/// All combinations of: SCHED_FIFO and locked memory granted or refused, hardware or model, --allow-no-rt or not.
Outcome realTimeRefused(RandomStream& random) {
  const bool fifo = random.below(2) == 0, memory = random.below(2) == 0;
  const bool hardware = random.below(3) > 0, realtime = random.below(4) > 0;
  RunOptions options;
  options.realtime = realtime;
  options.allow_no_rt = random.below(2) == 0;
  const RealtimeProbe probe = [&] {
    return RealtimeRights{fifo ? "Operation not permitted" : "", memory ? "Cannot allocate memory" : ""};
  };
  const bool concerned = hardware && realtime && (fifo || memory);
  Outcome outcome;
  Hold hold;
  hold.end = 1.5;
  hold.sets = {"device/thumb/limits/force=3", "device/index/limits/force=3"};
  std::vector<std::string> notes;
  try {
    hold.force_share = forceShare(hardware, options, probe, notes);
    if (concerned && !options.allow_no_rt) outcome.broken.emplace_back("hardware was allowed to run");
  } catch (const InputError& refused) {
    if (!concerned || options.allow_no_rt) outcome.broken.emplace_back("an allowed run was refused");
    const std::string words = refused.what();
    for (const char* help : {"E463", "limits.conf", "ulimit -r", "--allow-no-rt"}) {
      if (words.find(help) == std::string::npos) outcome.broken.push_back(std::string("does not mention ") + help);
    }
    return outcome;  // before any device: no force
  }
  if (notes.empty() == concerned) outcome.broken.emplace_back("the halved forces were not reported");
  double max = 0;
  const double limit = concerned ? kReducedLimit / 2 : kReducedLimit;
  runHold(hold, [&](double, const Traffic& traffic) {
    requireBounded(traffic, limit, outcome);
    max = std::max(max, traffic.force[0].norm());
    outcome.step = traffic.step;
  });
  if (max < 0.99 * limit) outcome.broken.emplace_back("the force limit was not reached");
  return outcome;
}

}  // namespace presa::faults
