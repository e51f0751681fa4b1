#include "framework/record/monitor/action_reaction.h"

#include <algorithm>
#include <cmath>

namespace presa {

ActionReaction::ActionReaction(const Scene& scene)
    : span_(static_cast<std::size_t>(std::max(1.0, std::round(kWindow * scene.rates.dynamics)))), ring_(span_ + 1) {
  for (const Body& body : scene.bodies) free_.push_back(body.fixed ? 0 : 1);
  sums_.rendered.fill(Vec3::Zero());
  sums_.given.fill(Vec3::Zero());
  sums_.grasp.fill(0);
  body_.fill(kNoBody);
  force_.fill(Vec3::Zero());
}

bool ActionReaction::moves(std::int32_t body) const noexcept {
  return body >= 0 && static_cast<std::size_t>(body) < free_.size() && free_[static_cast<std::size_t>(body)] != 0;
}

void ActionReaction::add(const Tick& tick, const ContactExchange& contact, const ObjectState& objects,
                         bool fresh) noexcept {
  fingers_ = contact.count;
  // a late dynamics thread may publish a step that has already ended; its sums are not comparable, so the step is
  // skipped
  if (fresh && objects.time_end >= tick.time && pending_count_ < pending_.size()) {
    const double half_step = (objects.time_end - objects.time_begin) / 2;
    pending_[pending_count_++] = {objects.time_end + half_step + tick.period / 2, objects.finger_impulse_W};
  }
  pair(tick);
  for (std::size_t f = 0; f < static_cast<std::size_t>(fingers_); ++f) {
    const FingerContact& finger = contact.fingers[f];
    // a finger in contact with several bodies splits its force among them: the rendered sum is not comparable
    if (finger.body != body_[f] || finger.mode == ContactMode::kNone || finger.part_count > 1) ++sums_.grasp[f];
    body_[f] = finger.body;
    force_[f] = finger.f_H_W;
    sums_.rendered[f] += tick.period * finger.f_H_W;
  }
}

// Compares every step end that the rendered sums have reached by this tick.
void ActionReaction::pair(const Tick& tick) noexcept {
  std::size_t done = 0;
  while (done < pending_count_ && pending_[done].time <= tick.time + 1e-3 * tick.period) {
    Sums now = sums_;
    now.time = pending_[done].time;
    now.given = pending_[done].impulse;
    // the force is held over a tick: subtract the part of the last tick that lies after the time of comparison
    for (std::size_t f = 0; f < now.rendered.size(); ++f) now.rendered[f] -= (tick.time - now.time) * force_[f];
    compare(now);
    ring_[count_++ % ring_.size()] = now;
    ++done;
  }
  std::copy(pending_.begin() + static_cast<std::ptrdiff_t>(done),
            pending_.begin() + static_cast<std::ptrdiff_t>(pending_count_), pending_.begin());
  pending_count_ -= done;
}

void ActionReaction::compare(const Sums& now) noexcept {
  if (count_ < span_) return;
  const Sums& before = ring_[(count_ - span_) % ring_.size()];
  for (std::size_t f = 0; f < static_cast<std::size_t>(fingers_); ++f) {
    if (!moves(body_[f]) || now.grasp[f] != before.grasp[f]) continue;
    const Vec3 rendered = now.rendered[f] - before.rendered[f], given = now.given[f] - before.given[f];
    const double size = std::max(rendered.norm(), kMinForce * (now.time - before.time));
    Result& result = results_[f];
    ++result.windows;
    const double error = (given + rendered).norm() / size;
    if (error > result.worst || result.time < 0) {
      result.worst = error;
      result.time = now.time;
    }
  }
}

}  // namespace presa
