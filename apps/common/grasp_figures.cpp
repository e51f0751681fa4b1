#include "apps/common/grasp_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include "framework/scene/joints/joint_motion.h"

namespace presa {
namespace {

constexpr double kRippleWindow = 2.0;  // [s] at the end of the hold, when the lift's transient has decayed

using Samples = std::span<const TraceSample>;

Samples between(const BoundedList<TraceSample>& trace, double begin, double end) {
  const auto earlier = [](const TraceSample& sample, double time) { return sample.time < time; };
  const auto first = std::lower_bound(trace.begin(), trace.end(), begin, earlier);
  const auto last = std::lower_bound(first, trace.end(), end, earlier);
  return {first, last};
}

bool holds(const FingerContact& finger, std::int32_t body) {
  return finger.mode != ContactMode::kNone && finger.body == body;
}
bool sticks(const FingerContact& finger, std::int32_t body) {
  return finger.mode == ContactMode::kStick && finger.body == body;
}

/// Samples in which at least two fingers touch the body.
std::size_t samplesGrasped(Samples samples, std::size_t fingers, std::int32_t body) {
  return static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [&](const TraceSample& sample) {
    const auto begin = sample.fingers.begin();
    return std::count_if(begin, begin + static_cast<std::ptrdiff_t>(fingers),
                         [&](const FingerContact& finger) { return holds(finger, body); }) >= 2;
  }));
}

std::optional<std::size_t> graspedObject(const RunResult& result, Samples hold) {
  std::optional<std::size_t> best;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < result.objects.size(); ++i) {
    if (result.objects[i].trace_slot < 0) continue;
    const std::size_t samples = samplesGrasped(hold, result.contact_points.size(), result.objects[i].body);
    if (samples > longest) {
      longest = samples;
      best = i;
    }
  }
  return best;
}

std::optional<double> gripRipple(Samples hold, std::size_t finger, double hold_end) {
  double low = std::numeric_limits<double>::infinity(), high = 0, sum = 0;
  std::size_t count = 0;
  for (const TraceSample& sample : hold) {
    if (sample.time < hold_end - kRippleWindow) continue;
    const double force = sample.fingers[finger].normal_force;
    low = std::min(low, force);
    high = std::max(high, force);
    sum += force;
    ++count;
  }
  if (!(sum > 0)) return std::nullopt;
  return (high - low) / (sum / static_cast<double>(count));
}

std::optional<SlipOnset> firstSlipFrom(const RunResult::ContactPoint& point, std::int32_t body, double release_begin) {
  // the monitor's list is complete until it is full; beyond that, the one onset that it always keeps is used
  for (const SlipOnset& slip : point.slips) {
    if (slip.time >= release_begin && slip.body == body) return slip;
  }
  const SlipOnset& kept = point.summary.release_slip;
  if (kept.time >= release_begin && kept.body == body) return kept;
  return std::nullopt;
}

/// The object moves, and so loads the finger, once in a period of the dynamics.
double fallBefore(const SlipOnset& slip, std::size_t finger, const BoundedList<TraceSample>& trace, double period) {
  const Samples before = between(trace, 0, slip.time - period + 1e-9);  // the tolerance is far below a tick
  return before.empty() ? 0 : std::max(0.0, before.back().fingers[finger].normal_force - slip.normal_force);
}

FingerGrasp fingerGrasp(Samples hold, std::size_t finger, const RunResult::Object& object) {
  FingerGrasp grasp;
  grasp.contact_point = finger;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  double normal_sum = 0, upward_sum = 0;
  std::size_t stick = 0;
  for (const TraceSample& sample : hold) {
    const FingerContact& contact = sample.fingers[finger];
    if (!holds(contact, object.body)) continue;
    const Vec3 p_BP = sample.bodies[static_cast<std::size_t>(object.trace_slot)].inverseTimes(contact.p_WP);
    low = low.cwiseMin(p_BP);
    high = high.cwiseMax(p_BP);
    normal_sum += contact.normal_force;
    // the listed force acts on the finger; its negative carries the object
    upward_sum -= contact.f_H_W.z();
    if (sticks(contact, object.body)) ++stick;
  }
  const auto samples = static_cast<double>(hold.size());
  grasp.stick_fraction = static_cast<double>(stick) / samples;
  grasp.offset_range = (high - low).norm();
  grasp.mean_normal_force = normal_sum / samples;
  grasp.weight_share = upward_sum / samples;
  return grasp;
}

/// Longest unbroken stretch in which every holding finger sticks. Each sample stands for the time to the next one.
double longestStick(Samples hold, const std::vector<FingerGrasp>& fingers, std::int32_t body, double hold_end) {
  double longest = 0, current = 0;
  for (std::size_t i = 0; i < hold.size(); ++i) {
    const bool all = std::all_of(fingers.begin(), fingers.end(), [&](const FingerGrasp& finger) {
      return sticks(hold[i].fingers[finger.contact_point], body);
    });
    const double next = i + 1 < hold.size() ? hold[i + 1].time : hold_end;
    current = all ? current + (next - hold[i].time) : 0;
    longest = std::max(longest, current);
  }
  return longest;
}

/// No joint holds the object, and no body effect pushes it.
bool carriedByFingers(const Scene& scene, std::int32_t body) {
  const auto pushes = [&](const PluginElement& element) {
    return element.kind == PluginKind::kBodyEffect && (element.body == body || element.body == kNoBody);
  };
  return !isJoined(scene.joints, static_cast<std::size_t>(body)) && std::ranges::none_of(scene.plugin_elements, pushes);
}

}  // namespace

std::optional<GraspFigures> graspFigures(const RunResult& result) {
  const std::optional<PhaseSpan> hold_phase = spanOf(result, PhaseIntent::kHold);
  if (!result.trace || !hold_phase) return std::nullopt;
  const std::optional<PhaseSpan> release = spanOf(result, PhaseIntent::kRelease);

  GraspFigures figures;
  figures.hold_begin = hold_phase->begin;
  // what is rendered while a stopped run fades is no grasp any more
  figures.hold_end = std::min(hold_phase->end, result.stopped_at < 0 ? result.simulated_seconds : result.stopped_at);
  figures.release_begin = release ? release->begin : std::numeric_limits<double>::infinity();
  figures.lifted = spanOf(result, PhaseIntent::kLift).has_value();
  const Samples hold = between(*result.trace, figures.hold_begin, figures.hold_end);
  const std::optional<std::size_t> held = graspedObject(result, hold);
  if (!held) return std::nullopt;
  figures.object = *held;
  const RunResult::Object& object = result.objects[*held];

  for (std::size_t f = 0; f < result.contact_points.size(); ++f) {
    const bool touched = std::any_of(hold.begin(), hold.end(),
                                     [&](const TraceSample& sample) { return holds(sample.fingers[f], object.body); });
    if (touched) figures.fingers.push_back(fingerGrasp(hold, f, object));
  }
  double height = 0;
  for (const TraceSample& sample : hold) height += sample.bodies[static_cast<std::size_t>(object.trace_slot)].p.z();
  figures.lift_height = height / static_cast<double>(hold.size()) - object.summary.start.z();
  figures.held_in_stick = longestStick(hold, figures.fingers, object.body, figures.hold_end);

  figures.carried = carriedByFingers(result.world->scene, object.body);
  if (figures.fingers.size() >= 2 && figures.carried) {
    figures.turn = graspTurn(*result.world, between(*result.trace, 0, figures.hold_end), figures.hold_begin,
                             {.first = figures.fingers[0].contact_point,
                              .second = figures.fingers[1].contact_point,
                              .body = object.body,
                              .slot = static_cast<std::size_t>(object.trace_slot)});
  }

  const double fair_share =
      object.mass * result.world->scene.gravity.norm() / static_cast<double>(figures.fingers.size());
  if (object.friction_static > 0 && figures.carried) figures.slip_limit = fair_share / object.friction_static;
  for (FingerGrasp& finger : figures.fingers) {
    const std::size_t f = finger.contact_point;
    finger.weight_share = fair_share > 0 ? finger.weight_share / fair_share : 0;
    finger.grip_ripple = gripRipple(hold, f, figures.hold_end);
    finger.slip = firstSlipFrom(result.contact_points[f], object.body, figures.release_begin);
    if (finger.slip)
      finger.slip_step = fallBefore(*finger.slip, f, *result.trace, 1 / result.world->scene.rates.dynamics);
  }
  return figures;
}

}  // namespace presa
