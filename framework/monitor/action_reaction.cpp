#include "framework/monitor/action_reaction.h"

#include <algorithm>
#include <cmath>

namespace presa {

ActionReaction::ActionReaction(const Scene& scene)
    : span_(static_cast<std::size_t>(std::max(1.0, std::round(kWindow * scene.rates.dynamics)))),
      ring_(span_ + kLastSteps + 1) {
  for (const Body& body : scene.bodies) free_.push_back(body.fixed ? 0 : 1);
  sums_.rendered.fill(Vec3::Zero());
  sums_.given.fill(Vec3::Zero());
  sums_.grasp.fill(0);
  sums_.body.fill(kNoBody);
  force_.fill(Vec3::Zero());
}

bool ActionReaction::moves(std::int32_t body) const noexcept {
  return body >= 0 && static_cast<std::size_t>(body) < free_.size() && free_[static_cast<std::size_t>(body)] != 0;
}

void ActionReaction::add(const Tick& tick, const ContactExchange& contact, const ObjectState& objects,
                         bool fresh) noexcept {
  fingers_ = contact.count;
  // a late dynamics thread may be behind; then its sums are not comparable and that step is passed over
  if (fresh && objects.time_end >= tick.time && pending_count_ < pending_.size()) {
    const double half_step = (objects.time_end - objects.time_begin) / 2;
    pending_[pending_count_++] = {objects.time_end + half_step + tick.period / 2, objects.finger_impulse_W};
  }
  pair(tick);
  for (std::size_t f = 0; f < static_cast<std::size_t>(fingers_); ++f) {
    const FingerContact& finger = contact.fingers[f];
    if (finger.body != sums_.body[f] || finger.mode == ContactMode::kNone) ++sums_.grasp[f];
    sums_.body[f] = finger.body;
    force_[f] = finger.f_H_W;
    sums_.rendered[f] += tick.period * finger.f_H_W;
  }
}

// What was rendered up to this tick is known now: the ends of steps that it reached can be compared.
void ActionReaction::pair(const Tick& tick) noexcept {
  std::size_t done = 0;
  while (done < pending_count_ && pending_[done].time <= tick.time + 1e-3 * tick.period) {
    Sums now = sums_;
    now.time = pending_[done].time;
    now.given = pending_[done].impulse;
    // the force is held over a tick: what the last one rendered after that time is taken off again
    for (std::size_t f = 0; f < now.rendered.size(); ++f) now.rendered[f] -= (tick.time - now.time) * force_[f];
    ring_[count_++ % ring_.size()] = now;
    compare();
    ++done;
  }
  std::copy(pending_.begin() + static_cast<std::ptrdiff_t>(done),
            pending_.begin() + static_cast<std::ptrdiff_t>(pending_count_), pending_.begin());
  pending_count_ -= done;
}

void ActionReaction::compare() noexcept {
  if (count_ <= span_ + kLastSteps) return;
  const auto ago = [&](std::size_t steps) -> const Sums& { return ring_[(count_ - 1 - steps) % ring_.size()]; };
  const Sums &now = ago(0), &end = ago(kLastSteps), &begin = ago(kLastSteps + span_);
  for (std::size_t f = 0; f < static_cast<std::size_t>(fingers_); ++f) {
    if (!moves(end.body[f]) || end.grasp[f] != begin.grasp[f]) continue;
    const Vec3 rendered = end.rendered[f] - begin.rendered[f], given = end.given[f] - begin.given[f];
    const double error = (given + rendered).norm() / std::max(rendered.norm(), kLeastForce * (end.time - begin.time));
    Result& result = results_[f];
    if (now.grasp[f] != end.grasp[f]) {
      result.at_end = std::max(result.at_end, error);
      continue;
    }
    ++result.windows;
    if (error > result.worst || result.time < 0) {
      result.worst = error;
      result.time = end.time;
    }
  }
}

}  // namespace presa
