#include <cmath>
#include <limits>

#include "experiments/faults/hold.h"

namespace presa::faults {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kAfter = 0.7;  // [s] observed after the fault

/// A moment while the fingers press: closing, lifting or holding.
double anyMoment(RandomStream& random) { return random.uniform(0.95, 2.6); }

Outcome judged(Hold hold, Judge judge) {
  runHold(hold, [&](double time, const Traffic& traffic) { judge.see(time, traffic); });
  return judge.outcome();
}

/// Modifies the thumb's samples from a random moment on, for `length` seconds.
Outcome sampleFails(RandomStream& random, double length, unsigned fingers,
                    const std::function<void(RandomStream&, FingerInput&)>& change) {
  const double begin = anyMoment(random);
  RandomStream bits(random.bits(), "sample");
  Hold hold;
  hold.end = begin + kAfter;
  hold.thumb = [&, begin, length](double time, FingerInput& sample) {
    if (time >= begin - 1e-9 && time < begin + length - 1e-9) change(bits, sample);
  };
  return judged(hold, Judge(begin, begin + length, fingers));
}

Outcome unplugged(RandomStream& random) {
  return sampleFails(random, kForever, 3, [](RandomStream&, FingerInput& sample) {
    sample = {};
    sample.lost = true;
  });
}

/// NaN, infinity, 1e308, or a jump of 0.1 to 1.1 m; permanent, so that a second bad sample follows.
Outcome impossibleSample(RandomStream& random) {
  const std::uint64_t kind = random.below(4);
  return sampleFails(random, kForever, 1, [kind](RandomStream& bits, FingerInput& sample) {
    const double bad[] = {kNan, kForever, 1e308, 0.1 + bits.uniform()};
    double& coordinate = sample.p_WH[static_cast<int>(bits.below(3))];
    coordinate = (kind == 3 ? coordinate : 0) + (bits.below(2) == 0 ? 1 : -1) * bad[kind];
  });
}

/// A single bad sample is bridged and must not change the force.
Outcome oneImpossibleSample(RandomStream& random) {
  Outcome outcome = sampleFails(random, 1e-3, 1, [](RandomStream& bits, FingerInput& sample) {
    sample.p_WH.x() = bits.below(2) == 0 ? kNan : 1e9;
  });
  if (outcome.detection >= 0) outcome.broken.emplace_back("one bad sample reduced the force");
  outcome.detection = outcome.zero = 0;
  return outcome;
}

Outcome silent(RandomStream& random) {
  const double length = 1e-3 * static_cast<double>(6 + random.below(200));
  return sampleFails(random, length, 1, [](RandomStream&, FingerInput& sample) { sample = {}; });
}

/// Isolated missing replies, too few to take the force to zero.
Outcome stutters(RandomStream& random) {
  const double begin = anyMoment(random);
  RandomStream bits(random.bits(), "replies");
  Hold hold;
  hold.end = begin + kAfter;
  hold.thumb = [&](double time, FingerInput& sample) {
    if (time >= begin && bits.below(4) == 0) sample = {};
  };
  Outcome outcome = judged(hold, Judge(begin, kForever, 1));
  outcome.detection = outcome.zero = 0;  // a reaction is allowed, not required
  return outcome;
}

Outcome held(RandomStream& random, RateGroup group, double length) {
  const double begin = anyMoment(random);
  Hold hold;
  hold.end = begin + std::min(length, 0.5) + kAfter;
  hold.held_up = [=](RateGroup asked, double time) {
    return asked == group && time >= begin - 1e-9 && time < begin + length - 1e-9;
  };
  return judged(hold, Judge(begin, begin + length));
}

Outcome dynamicsStalls(RandomStream& random) {
  return held(random, RateGroup::kDynamics, random.below(2) == 0 ? 0.05 : 0.5);
}
Outcome dynamicsDies(RandomStream& random) { return held(random, RateGroup::kDynamics, kForever); }
Outcome collisionDies(RandomStream& random) { return held(random, RateGroup::kCollision, kForever); }

/// The haptic thread is late by 1.5, 5 or 50 ms. Nothing can be sent meanwhile; the following forces are judged.
Outcome overrun(RandomStream& random) {
  const double lengths[] = {0.0015, 0.005, 0.05};
  Outcome outcome = held(random, RateGroup::kHaptic, lengths[random.below(3)]);
  outcome.detection = outcome.zero = 0;
  return outcome;
}

/// Fingers start inside the object.
Outcome startsInside(RandomStream& random) {
  Hold hold;
  hold.deep = random.uniform(0.001, 0.06);
  hold.end = 1.0;
  hold.closed = 5;
  double max_rise = 0, before = 0, first = -1;
  Outcome outcome;
  runHold(hold, [&](double time, const Traffic& traffic) {
    const double now = std::max(traffic.force[0].norm(), traffic.force[1].norm());
    max_rise = std::max(max_rise, now - before);
    if (first < 0) first = now;
    // 8 N over half a second: the soft start
    if (now > 8 * (time + 2e-3) / 0.5 + 1e-9) outcome.broken.emplace_back("the force was not ramped up");
    before = now;
    outcome.step = traffic.step;
  });
  return outcome;
}

}  // namespace

std::vector<Fault> holdFaults() {
  return {
      {1,
       "device unplugged in the grasp",
       "the other device goes to zero; nothing comes back without a re-arm",
       {0.003, 0.020, false},
       unplugged},
      {2,
       "samples NaN, infinite, 1e308, or a jump, for good",
       "rejected; zero and latched by the second",
       {0.003, 0.010, false},
       impossibleSample},
      {2, "one such sample alone", "bridged by the last good one", {}, oneImpossibleSample},
      {4,
       "replies missing for 6 to 205 ms",
       "held 2 ms at most, then to zero; softly back",
       {0.003, 0.005, false},
       silent},
      {4, "a quarter of the replies missing", "no step, no burst", {}, stutters},
      {5,
       "dynamics stalls 50 or 500 ms",
       "contact with the frozen pose, faded after 20 ms",
       {0, 0, true},
       dynamicsStalls},
      {5, "dynamics dies", "faded after 20 ms", {0, 0.045, true}, dynamicsDies},
      {6, "collision dies", "zero within three periods", {0, 0.030, true}, collisionDies},
      {11, "haptic thread late by 1.5, 5 or 50 ms", "no step", {}, overrun},
      {16, "fingers start inside the object", "force from zero, no ejection", {}, startsInside},
  };
}

}  // namespace presa::faults
