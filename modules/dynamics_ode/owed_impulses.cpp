#include "modules/dynamics_ode/owed_impulses.h"

#include <algorithm>

#include "framework/geometry/index.h"

namespace presa::ode {

void OwedImpulses::makeRoom(const ContactExchange& exchange) {
  // those that touch, and those that just let go
  const std::size_t room = 2 * std::max(exchange.fingers.size(), exchange.contacts.capacity());
  if (all_.capacity() < room) all_ = BoundedList<Owed>(room);
}

OwedImpulses::Owed* OwedImpulses::find(std::size_t finger, std::size_t body) noexcept {
  Owed* const found = std::ranges::find_if(
      all_, [&](const Owed& one) { return index(one.finger) == finger && index(one.body) == body; });
  return found == all_.end() ? nullptr : found;
}

void OwedImpulses::read(const ContactExchange& exchange, double period, const BodySet& bodies) {
  makeRoom(exchange);
  period_ = period;
  for (std::size_t i = all_.size(); i-- > 0;) {
    Owed& one = all_[i];
    if (!one.touches) {
      all_.remove(i);
      continue;
    }
    const bool is_unpaid = one.is_new && !one.moves;
    if (!is_unpaid) one.felt_W = Vec3::Zero();
    one.taken_back_W = -one.predicted_W;
    one.predicted_W = Vec3::Zero();
    one.p_BP_before = one.p_BP;
    one.touches = one.is_new = false;
    one.moves = bodies.moves(index(one.body));
  }
  for (std::size_t f = 0; f < exchange.fingers.size(); ++f) {
    const FingerContact& finger = exchange.fingers[f];
    if (finger.mode == ContactMode::kNone || !isUsable(finger)) continue;
    for (const ToolContact& contact : exchange.contactsOf(finger)) read(f, contact, bodies);
  }
}

void OwedImpulses::read(std::size_t finger, const ToolContact& contact, const BodySet& bodies) {
  const auto body = static_cast<std::size_t>(contact.body);
  if (contact.body < 0 || body >= bodies.size() || !contact.f_H_W.allFinite()) return;
  Owed* one = find(finger, body);
  if (one == nullptr) {
    const bool moves = bodies.moves(body);
    one = all_.add({static_cast<std::int32_t>(finger), contact.body, moves});
  }
  if (one == nullptr) return;
  one->p_BP = contact.p_BP;
  one->felt_W -= period_ * contact.f_H_W;
  one->touches = true;
}

void OwedImpulses::push(BodySet& bodies) {
  for (Owed& one : all_) {
    if (!one.moves) continue;
    const std::size_t body = index(one.body);
    const Pose X_WB = bodies.pose(body);
    bodies.addForce(body, one.felt_W / period_, X_WB * one.p_BP);
    bodies.addForce(body, one.taken_back_W / period_, X_WB * one.p_BP_before);
  }
}

void OwedImpulses::notePredicted(const FingerJoints& fingers, double h) {
  for (std::size_t i = 0; i < fingers.count(); ++i) {
    if (Owed* const one = find(fingers.finger(i), fingers.body(i))) one->predicted_W += h * fingers.force(i);
  }
}

void OwedImpulses::leaveOutPredicted(BoundedList<FingerImpulse>& given) const noexcept {
  for (const Owed& one : all_) {
    const auto same = [&](const FingerImpulse& other) { return other.finger == one.finger && other.body == one.body; };
    if (const auto found = std::ranges::find_if(given, same); found != given.end()) found->impulse_W -= one.predicted_W;
  }
}

}  // namespace presa::ode
