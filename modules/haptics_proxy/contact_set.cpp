#include "modules/haptics_proxy/contact_set.h"

#include <algorithm>
#include <array>
#include <span>

namespace presa {
namespace {

constexpr std::size_t kMaxPlanes = std::tuple_size_v<decltype(ActiveSet::member)>;
// Planes of several bodies may be parallel. Their cosines times this keep M positive definite, at most 5.3.
constexpr double kIndependent = 0.9;

std::span<ToolContact> contactsOf(const FingerTick& tick) noexcept {
  return {tick.all.contacts.begin() + tick.out.first_contact, tick.out.contact_count};
}

bool heldByOne(const FingerTick& tick) noexcept {
  const ActiveSet& active = tick.contact.active;
  bool one = tick.own_contacts.empty();
  for (int a = 0; a < active.count; ++a) {
    const ActiveSet::Member& member = active.member[static_cast<std::size_t>(a)];
    one = one && (member.body == tick.contact.body || !(member.weight > 0));
  }
  return one;
}

// The contacts without friction, still in A: the renderer's own, or else one for each body of the active set. `depth`
// is the sum of the multipliers.
std::span<ToolContact> gather(FingerTick& tick) noexcept {
  BoundedList<ToolContact>& contacts = tick.all.contacts;
  tick.out.first_contact = static_cast<std::uint32_t>(contacts.size());
  const auto mine = [&] { return std::span(contacts.begin() + tick.out.first_contact, contacts.end()); };
  for (const RenderedContact& own : tick.own_contacts) {
    contacts.add({.body = own.body, .stretch_W = own.depth * own.nhat, .depth = own.depth});
  }
  const ActiveSet& active = tick.contact.active;
  for (int a = 0; a < active.count && tick.own_contacts.empty(); ++a) {
    const ActiveSet::Member& member = active.member[static_cast<std::size_t>(a)];
    if (!(member.weight > 0)) continue;
    const auto same = std::ranges::find(mine(), member.body, &ToolContact::body);
    ToolContact& one = same != mine().end() ? *same : *contacts.add({.body = member.body});
    one.stretch_W += member.weight * member.nhat;
    one.depth += member.weight;
  }
  tick.out.contact_count = static_cast<std::uint32_t>(mine().size());
  return mine();
}

/// Normals and motion of the planes that hold a finger.
struct Planes {
  std::array<Vec3, kMaxPlanes> nhat_W, v_WB;
  std::array<double, kMaxPlanes> closing;  // n . (velocity of the body - velocity of the finger) [m/s]
  Mat3 M = Mat3::Identity();
  Mat3 along = Mat3::Identity();  // projection on the directions along all planes: only there is friction
};

Planes planesOf(const FingerTick& tick, std::span<const ToolContact> contacts) noexcept {
  Planes planes;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vec3 nhat = tick.touchables.frameOf(contacts[i].body).q * contacts[i].nhat_B;
    const Vec3 v_WB = tick.touchables.velocityAt(contacts[i].body, tick.out.p_WP);
    planes.nhat_W[i] = nhat;
    planes.v_WB[i] = v_WB;
    keepAlong(nhat, planes.along);
    planes.closing[i] = nhat.dot(v_WB - tick.out.v_WH);
  }
  Mat3 products = Mat3::Identity();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
      products(a, b) = products(b, a) = kIndependent * planes.nhat_W[i].dot(planes.nhat_W[j]);
    }
  }
  planes.M = products.inverse();
  return planes;
}

// `rate`: ds/dt of the multiplier; `stiffer`: M_ii.
void finish(const FingerContact& finger, const Vec3& nhat_W, double rate, double stiffer, ToolContact& one) noexcept {
  one.f_H_W = finger.stiffness * one.stretch_W + finger.damping * rate * nhat_W;
  // a damper does not pull
  one.f_H_W -= std::min(0.0, one.f_H_W.dot(nhat_W)) * nhat_W;
  one.stiffness = stiffer * finger.stiffness;
  one.damping = stiffer * finger.damping;
  one.stretch_W /= stiffer;
  one.depth /= stiffer;
  one.tangential_ratio /= stiffer;
  one.damped_W /= stiffer;
}

void finishSeveral(FingerTick& tick, std::span<ToolContact> contacts) noexcept {
  FingerContact& out = tick.out;
  Vec3 sum = Vec3::Zero();
  if (tick.own_contacts.empty()) {
    const Planes planes = planesOf(tick, contacts);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      double rate = 0;
      for (std::size_t j = 0; j < contacts.size(); ++j)
        rate += planes.M(row, static_cast<Eigen::Index>(j)) * planes.closing[j];
      const double stiffer = planes.M(row, row);
      const Vec3 &v_WB = planes.v_WB[i], &nhat = planes.nhat_W[i];
      contacts[i].v_WH = v_WB + planes.along * (out.v_WH - v_WB) - rate / stiffer * nhat;
      finish(out, nhat, rate, stiffer, contacts[i]);
      sum += contacts[i].f_H_W;
    }
  } else {
    for (ToolContact& one : contacts) {  // springs of their own already
      const Vec3 nhat = tick.touchables.frameOf(one.body).q * one.nhat_B;
      one.v_WH = out.v_WH;
      finish(out, nhat, nhat.dot(tick.touchables.velocityAt(one.body, out.p_WP) - out.v_WH), 1, one);
      sum += one.f_H_W;
    }
  }
  out.f_H_W = sum;
  out.normal_force = std::max(0.0, sum.dot(out.nhat_W));
  out.tangential_force_W = sum - out.normal_force * out.nhat_W;
}

const BodyFriction* frictionWith(std::int32_t body, const FingerTick& tick) noexcept {
  const auto found = std::ranges::find(tick.friction, body, &BodyFriction::body);
  return found == tick.friction.end() ? nullptr : &*found;
}

/// The part of the body's friction that one of its contacts has.
void addFriction(const FingerTick& tick, const BodyFriction& friction, double part, ToolContact& one) noexcept {
  const FrictionAnswer& answer = friction.answer;
  const double share = part * friction.share;
  one.stretch_W += share * answer.stretch;
  one.mode = friction.slipping ? ContactMode::kSlip : ContactMode::kStick;
  one.friction_static = answer.bound;
  one.friction_dynamic = answer.bound_sliding;
  one.tangential_ratio = share * answer.ratio;
  one.tangential_damping = share * answer.damping;
  one.damped_W = share * (tick.X_WA.q * answer.damped);
}

/// Friction with the body that bears the largest share, as the finger's own.
void writeFriction(FingerTick& tick) noexcept {
  const BodyFriction* main = frictionWith(tick.contact.body, tick);
  if (main == nullptr) main = tick.friction.data();
  const FrictionAnswer& answer = main->answer;
  tick.out.friction_static = answer.bound;
  tick.out.friction_dynamic = answer.bound_sliding;
  tick.out.tangential_ratio = answer.ratio;
  tick.out.tangential_damping = answer.damping;
  if (answer.damping > 0) tick.out.damped_W = tick.X_WA.q * answer.damped;
}

/// Displacement between proxy and HIP that neither the normals nor the friction of the contacts explain: effects cause
/// it, and friction with a body that held the finger when the tick began but is no contact any more.
Vec3 unexplained(const FingerTick& tick, std::span<const ToolContact> contacts) noexcept {
  Vec3 rest = tick.contact.x - tick.g;
  for (const ToolContact& one : contacts) rest -= one.stretch_W;
  for (const BodyFriction& one : tick.friction) {
    const bool holds = std::ranges::find(contacts, one.body, &ToolContact::body) != contacts.end();
    if (holds) rest -= one.share * one.answer.stretch;
  }
  return rest;
}

}  // namespace

void divideContact(FingerTick& tick) noexcept {
  if (!tick.friction.empty()) writeFriction(tick);
  if (heldByOne(tick)) {  // finishContacts writes all of it
    tick.out.first_contact = static_cast<std::uint32_t>(tick.all.contacts.size());
    tick.out.contact_count = 1;
    tick.all.contacts.add();
    return;
  }
  const std::span<ToolContact> mine = gather(tick);
  if (mine.size() < 2) return;
  const Vec3 rest = unexplained(tick, mine);
  const auto multipliersOf = [&](const ToolContact* same) {
    double sum = 0;
    for (const ToolContact& one : mine) sum += same == nullptr || one.body == same->body ? one.depth : 0;
    return sum;
  };
  const double total = multipliersOf(nullptr);
  for (ToolContact& one : mine) {
    const Pose X_BA = tick.touchables.frameOf(one.body).inverse() * tick.X_WA;
    one.nhat_B = X_BA.q * one.stretch_W.normalized();
    one.p_BP = X_BA * tick.contact.x;
    one.mode = ContactMode::kSlip;
    one.stretch_W += one.depth / total * rest;
    if (const BodyFriction* friction = frictionWith(one.body, tick))
      addFriction(tick, *friction, one.depth / multipliersOf(&one), one);
    one.stretch_W = tick.X_WA.q * one.stretch_W;
  }
  for (ToolContact& one : mine) one.p_WP = tick.X_WA * tick.contact.x;
  for (ToolContact& one : mine) one.depth = one.stretch_W.dot(tick.touchables.frameOf(one.body).q * one.nhat_B);
}

void finishContacts(FingerTick& tick) noexcept {
  FingerContact& out = tick.out;
  const std::span<ToolContact> mine = contactsOf(tick);
  if (mine.size() > 1) return finishSeveral(tick, mine);
  if (mine.empty()) return;
  mine[0] = {.body = out.body,
             .p_BP = out.p_BP,
             .p_WP = out.p_WP,
             .nhat_B = out.nhat_B,
             .v_WH = out.v_WH,
             .stretch_W = out.p_WP - out.p_WH,
             .depth = out.depth,
             .stiffness = out.stiffness,
             .damping = out.damping,
             .mode = out.mode,
             .friction_static = out.friction_static,
             .friction_dynamic = out.friction_dynamic,
             .tangential_ratio = out.tangential_ratio,
             .tangential_damping = out.tangential_damping,
             .damped_W = out.damped_W,
             .f_H_W = out.f_H_W};
}

}  // namespace presa
