#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/methods.h"
#include "experiments/study/compliant_finger.h"

namespace presa::stability::stall_while_holding {
namespace {

constexpr double kGrip = 6, kStiffness = 1000;                  // of the scene's terracotta [N, N/m]
constexpr double kForceRate = 1000;                             // slew limit of the scene [N/s]
constexpr double kSoftStart = 0.5;                              // of the output stage [s]
constexpr double kLiftBegin = 1.2, kLiftEnd = 2.2, kAfter = 2;  // [s]
constexpr double kWhileLifting = 1.7, kWhileHolding = 3.5;

struct Stall {
  RateGroup group = RateGroup::kDynamics;
  double begin = 0, length = 0;  ///< [s]
  Method method;
};

struct Outcome {
  double step = 0;           ///< max change of the force at a device [N]
  double energy_during = 0;  ///< max energy delivered to the hand during the stall [J]
  double sampling = 0;       ///< energy that a spring sampled at the haptic rate may add [J]
  double energy_after = 0;   ///< max energy delivered to the hand after the stall [J]
  double reload = 0;         ///< energy needed to load the hand again after a fade at rest [J]
  double hand_way = 0;       ///< distance moved by the hand during the stall [m]
  Vec3 object = Vec3::Zero();
  Curve force{"force on the thumb", {}, {}};
};

Pinch pinchOf(const HandImpedance& hand) {
  Pinch pinch;
  pinch.center = {0, 0, 0.082};
  pinch.width = 0.08;
  pinch.depth = kGrip / hand.stiffness + kGrip / kStiffness;
  pinch.open = 0.01;
  pinch.close_end = 0.9;
  pinch.lift = 0.06;
  pinch.lift_begin = kLiftBegin;
  pinch.lift_end = kLiftEnd;
  return pinch;
}

/// Work that loads one finger again after its force F has faded: F^2 / 2k for the spring of the hand, plus the loss in
/// its damper on the way back. While the gain g = t / T rises over the soft start, the balance k y = g K (D - y) with D
/// = F / k + F / K gives y(t), and the integral of b y'^2 is b D^2 K / (3 k T) (1 - (k / (k + K))^3).
double reloadOf(const HandImpedance& hand, double force) {
  const double k = hand.stiffness, K = kStiffness, D = force / k + force / K, q = k / (k + K);
  return force * force / (2 * k) + hand.damping * D * D * K / (3 * k * kSoftStart) * (1 - q * q * q);
}

Outcome hold(const Stall& stall) {
  const HandImpedance hand;
  const Pinch pinch = pinchOf(hand);
  double clock = 0;
  std::array<Transport, 2> transports;
  DeviceList fingers;
  for (const std::size_t f : {0UL, 1UL}) {
    const auto target = [pinch, side = f == 0 ? -1.0 : 1.0](double time) { return pinchState(pinch, side, time); };
    fingers.push_back(std::make_unique<CompliantFinger>(hand, target, clock, transports[f]));
  }
  const double end = stall.begin + stall.length;
  StudyRun run(specOf("stall_while_holding.xml", stall.method.sets, end + kAfter), std::move(fingers));
  const std::size_t amphora = bodyNamed(run.world(), "amphora");

  Outcome out;
  double at_begin = 0, at_end = 0;
  std::array<Vec3, 2> last{};
  run.delay([&](RateGroup group, double time) {
    clock = time;
    return group == stall.group && time >= stall.begin && time < end;
  });
  run.observe([&](const HapticSample& sample) {
    const double energy = transports[0].energy + transports[1].energy;
    if (clock < stall.begin) {
      at_begin = at_end = energy;
      out.reload = reloadOf(hand, transports[0].force.norm()) + reloadOf(hand, transports[1].force.norm());
    } else if (clock <= end) {
      out.energy_during = std::max(out.energy_during, energy - at_begin);
      for (const std::size_t f : {0UL, 1UL}) {
        out.sampling += kStiffness / 2 * (sample.device.fingers[f].p_WH - last[f]).squaredNorm();
      }
      at_end = energy;
    } else {
      out.energy_after = std::max(out.energy_after, energy - at_end);
    }
    out.step = std::max(transports[0].largest_step, transports[1].largest_step);
    for (const std::size_t f : {0UL, 1UL}) last[f] = sample.device.fingers[f].p_WH;
    if (clock > stall.begin - 0.1) {
      out.force.x.push_back(clock - stall.begin);
      out.force.y.push_back(transports[0].force.norm());
    }
    out.object = sample.objects->poseAt(static_cast<std::int32_t>(amphora), sample.tick.time).p;
  });
  run.run();
  out.hand_way = (pinchState(pinch, 1, end).p_WH - pinchState(pinch, 1, stall.begin).p_WH).norm();
  return out;
}

std::vector<Finding> judgeStall(const Stall& stall) {
  Outcome out = hold(stall);
  Stall none = stall;
  none.group = RateGroup::kView;
  const Vec3 undisturbed = hold(none).object;

  Finding step = finding("largest force step", out.step, "N", kForceRate * 1e-3 * (1 + 1e-9),
                         "slew limit at the device: 1000 N/s for one tick");
  step.plot_x = "time from the stall [s]";
  step.plot_y = "force on the thumb [N]";
  step.curves.push_back(decimated(std::move(out.force)));
  return {step,
          finding("energy given to the hand in the stall", 1000 * out.energy_during, "mJ", 1000 * out.sampling,
                  "at most the energy added by sampling a spring: k/2 dx^2 per tick"),
          finding("energy given to the hand after it", 1000 * out.energy_after, "mJ", 1000 * out.reload,
                  "at most the energy to load a hand at rest again: its spring, and its damper over the soft start"),
          finding("object off its way", 1000 * (out.object - undisturbed).norm(), "mm", 1 + 1000 * out.hand_way,
                  "2 s later at most as far off as the hand moved during the stall")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "stall_while_holding";
  result.title = "A thread stalls while two compliant fingers hold an amphora";
  result.source =
      "Passivity of a device that holds its last force: E = sum f(k-1) (x(k) - x(k-1)) (Stramigioli et al. 2005). A "
      "frozen "
      "object is a spring, a fading one gives less than a spring; only afterwards may the device load the hand again.";
  result.oracle =
      "No force step above the slew limit; no energy to the hand in the stall; afterwards no more than the hand's "
      "springs "
      "take; the object is held on.";
  result.scene = "stall_while_holding.xml";
  struct Kind {
    const char* thread;
    RateGroup group;
    std::vector<double> lengths;
  };
  const Method bare{"no watchdog, no slew limit",
                    {"device/thumb/limits/watchdog_ms=100000", "device/index/limits/watchdog_ms=100000",
                     "device/thumb/limits/force_rate=1e6", "device/index/limits/force_rate=1e6"}};
  for (const Kind& kind :
       {Kind{"dynamics", RateGroup::kDynamics, {0.05, 0.5}}, Kind{"collision", RateGroup::kCollision, {0.2}},
        Kind{"haptic", RateGroup::kHaptic, {0.0015, 0.005, 0.05}}}) {
    for (const double length : kind.lengths) {
      for (const bool lifting : {false, true}) {
        for (const Method& method : {ours(), bare}) {
          Trial trial;
          trial.parameters = {{"stalled", kind.thread},
                              {"for", number(1000 * length) + " ms"},
                              {"while", lifting ? "lifting" : "holding"}};
          trial.method = method.name;
          // the hand has risen 30 mm to the shoulder of the amphora, where no pinch holds: the amphora slips out
          const bool left = lifting && kind.group == RateGroup::kDynamics && length > 0.4;
          if (left) trial.expected = Verdict::kDrift;
          if (!method.own()) trial.expected = Verdict::kUnstable;
          const Stall stall{kind.group, lifting ? kWhileLifting : kWhileHolding, length, method};
          trial.run = [stall] { return judgeStall(stall); };
          trial.quick = !lifting && length > 0.04 && length < 0.06 && method.own();
          result.trials.push_back(std::move(trial));
        }
      }
    }
  }
  return result;
}

}  // namespace presa::stability::stall_while_holding
