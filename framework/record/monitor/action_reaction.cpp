#include "framework/record/monitor/action_reaction.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

template <class List>
auto* find(List& list, std::int32_t finger, std::int32_t body) noexcept {
  auto* found = std::ranges::find_if(list, [&](const auto& one) { return one.finger == finger && one.body == body; });
  return found == list.end() ? nullptr : found;
}

}  // namespace

ActionReaction::Giver::Giver(std::size_t span, const BoundedList<Touch>& touches) : ring(span + 1) {
  for (Sums& sums : ring) sums.touches = touches;
  for (Given& given : pending) given.impulses = BoundedList<FingerImpulse>(touches.capacity());
}

ActionReaction::ActionReaction(const Scene& scene)
    : span_(static_cast<std::size_t>(std::max(1.0, std::round(kWindow * scene.rates.dynamics)))),
      touches_(scene.devices.size() * std::min<std::size_t>(scene.bodies.size(), kMaxNearBodies)),
      results_(scene.devices.size()) {
  for (const Body& body : scene.bodies) free_.push_back(body.fixed ? 0 : 1);
  const bool held = scene.dynamics.coupling == DynamicsSettings::Coupling::kHapticRate;
  givers_.assign(held ? 2 : 1, Giver(span_, touches_));
  if (held) felt_.assign(kTicksKept, Sums{-1, touches_});
}

bool ActionReaction::moves(std::int32_t body) const noexcept {
  return body >= 0 && static_cast<std::size_t>(body) < free_.size() && free_[static_cast<std::size_t>(body)] != 0;
}

// Room for what was given up to `time`; null: none left.
ActionReaction::Given* ActionReaction::giveAt(Giver& giver, double time) noexcept {
  if (giver.pending_count == giver.pending.size()) return nullptr;
  Given& given = giver.pending[(giver.pending_begin + giver.pending_count++) % giver.pending.size()];
  given.time = time;
  given.impulses.clear();
  return &given;
}

void ActionReaction::add(const Tick& tick, const ContactExchange& contact, const ObjectState& objects,
                         bool fresh) noexcept {
  // a late dynamics thread may publish a step that has already ended; its sums are not comparable, so the step is
  // skipped
  if (fresh && objects.time_end >= tick.time) {
    const double half_step = (objects.time_end - objects.time_begin) / 2;
    Given* const own = giveAt(givers_[0], objects.time_end + half_step + tick.period / 2);
    // of a held body the forces of all ticks that have ended
    Given* const held = givers_.size() > 1 ? giveAt(givers_[1], objects.held_time) : nullptr;
    for (const FingerImpulse& one : objects.touches) {
      if (Given* const given = one.until == FingerImpulse::kNoEnd ? own : held) given->impulses.add(one);
    }
  }
  if (!felt_.empty()) {
    newest_ = (newest_ + 1) % felt_.size();
    felt_[newest_].time = tick.time;
    felt_[newest_].touches = touches_;
  }
  for (Giver& giver : givers_) pair(tick, giver);
  sum(tick, contact);
}

void ActionReaction::sum(const Tick& tick, const ContactExchange& contact) noexcept {
  for (Touch& touch : touches_) touch.renewed = false;
  for (std::size_t f = 0; f < contact.fingers.size(); ++f) {
    const FingerContact& finger = contact.fingers[f];
    if (finger.mode == ContactMode::kNone) continue;
    for (const ToolContact& one : contact.contactsOf(finger)) {
      if (moves(one.body)) sum(tick, static_cast<std::int32_t>(f), one);
    }
  }
  for (std::size_t i = touches_.size(); i-- > 0;) {
    if (!touches_[i].renewed) touches_.remove(i);  // the last one, renewed, takes its place
  }
}

void ActionReaction::sum(const Tick& tick, std::int32_t finger, const ToolContact& contact) noexcept {
  Touch* touch = find(touches_, finger, contact.body);
  if (touch == nullptr) touch = touches_.add({.finger = finger, .body = contact.body, .since = tick.time});
  if (touch == nullptr) return;
  // a renderer may have several contacts of one body
  touch->force = touch->renewed ? Vec3(touch->force + contact.f_H_W) : contact.f_H_W;
  touch->rendered += tick.period * contact.f_H_W;
  touch->renewed = true;
}

// The oldest sums known that reach `time`; null: it is too long ago.
const ActionReaction::Sums* ActionReaction::feltBy(double time) const noexcept {
  const Sums* found = nullptr;
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    const Sums& sums = felt_[(newest_ + felt_.size() - i) % felt_.size()];
    if (sums.time < time) return found;
    found = &sums;
  }
  return nullptr;
}

// Compares every step end that the rendered sums have reached by this tick.
void ActionReaction::pair(const Tick& tick, Giver& giver) noexcept {
  const double tolerance = 1e-3 * tick.period;
  while (giver.pending_count > 0 && giver.pending[giver.pending_begin].time <= tick.time + tolerance) {
    const Given& given = giver.pending[giver.pending_begin];
    giver.pending_begin = (giver.pending_begin + 1) % giver.pending.size();
    --giver.pending_count;
    const Sums* const felt = feltBy(given.time - tolerance);
    if (!felt_.empty() && felt == nullptr) continue;
    const double time = felt_.empty() ? tick.time : felt->time;  // of the sums
    Sums& now = giver.ring[giver.count % giver.ring.size()];
    now.time = given.time;
    now.touches.clear();
    for (const Touch& touch : felt_.empty() ? touches_ : felt->touches) {
      const FingerImpulse* impulse = find(given.impulses, touch.finger, touch.body);
      if (impulse == nullptr) continue;
      Touch* sums = now.touches.add(touch);
      // the force is held over a tick: subtract the part of the last tick that lies after the time of comparison
      sums->rendered -= (time - now.time) * touch.force;
      sums->given = impulse->impulse_W;
      sums->given_since = impulse->since;
    }
    compare(giver, now);
    ++giver.count;
  }
}

void ActionReaction::compare(const Giver& giver, const Sums& now) noexcept {
  if (giver.count < span_) return;
  const Sums& before = giver.ring[(giver.count - span_) % giver.ring.size()];
  for (const Touch& end : now.touches) {
    const Touch* begin = find(before.touches, end.finger, end.body);
    if (begin == nullptr || begin->since != end.since || begin->given_since != end.given_since) continue;
    const Vec3 rendered = end.rendered - begin->rendered, given = end.given - begin->given;
    const double size = std::max(rendered.norm(), kMinForce * (now.time - before.time));
    Result& result = results_[static_cast<std::size_t>(end.finger)];
    ++result.windows;
    const double error = (given + rendered).norm() / size;
    if (error > result.worst || result.time < 0) {
      result.worst = error;
      result.time = now.time;
    }
  }
}

}  // namespace presa
