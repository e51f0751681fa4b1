#include "modules/xfca/pair_objects.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

// Objects ride this far above the surface, so that a part that the step takes them below it is still found by its
// distance, which has a direction; forces do not see it [m].
constexpr double kAbove = 2e-4;
constexpr double kMaxStep = 0.75 * kAbove;  // towards the handle
constexpr double kShortWay = 1e-7;          // a shorter way ends the passes [m]
constexpr int kMaxPasses = 8;
constexpr double kRounding = 1e-7;  // added to the step [m]

}  // namespace

double stepTowardsHandle(double radius, double d) noexcept {
  return d < radius ? radius - std::sqrt(radius * radius - d * d) : radius;
}

bool PairObjects::begin(const NearParts& pair, const Pose& X_WH, const Pose& X_WB, Contact& contact) noexcept {
  if (pair.gap >= 0) return false;
  const Vec3 at_W = X_WH.p + (kAbove - pair.gap) * pair.nhat_W;
  contact.touching = true;
  contact.slipping = false;
  contact.surface_B = contact.god_B = X_WB.inverseTimes(at_W);
  contact.nhat_B = contact.god_nhat_B = X_WB.q.conjugate() * pair.nhat_W;
  return true;
}

// A way is cut where its step would be larger than kMaxStep, and goes on in the next pass.
bool PairObjects::moveTo(NearParts& pair, const Quat& q_WT, const Vec3& goal, Vec3& x, Vec3& nhat) noexcept {
  const double longest = std::sqrt(kMaxStep * std::max(0.0, 2 * law_.curvature - kMaxStep));
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const Vec3 way = goal - x, along = way - way.dot(nhat) * nhat;
    const double length = along.norm(), d = std::min(length, longest);
    const Vec3 at = x + (length > 0 ? Vec3(d / length * along) : Vec3::Zero()) -
                    (stepTowardsHandle(law_.curvature, d) + kRounding) * nhat;
    pairs_.separate(pair, {at, q_WT}, 2 * kAbove);
    if (pair.gap > kAbove) return false;
    nhat = pair.nhat_W;
    x = at + (kAbove - pair.gap) * nhat;
    if (d < kShortWay) break;
  }
  return true;
}

bool PairObjects::follow(NearParts& pair, const Pose& X_WH, const Pose& X_WB, Contact& contact) noexcept {
  Vec3 surface = X_WB * contact.surface_B, god = X_WB * contact.god_B;
  Vec3 nhat = X_WB.q * contact.nhat_B, god_nhat = X_WB.q * contact.god_nhat_B;
  if ((X_WH.p - (god - kAbove * god_nhat)).dot(god_nhat) >= 0) return false;
  NearParts at_god = pair;
  // without a surface there, the surface-object waits where it found the last one
  moveTo(pair, X_WH.q, X_WH.p, surface, nhat);
  const double depth = (X_WH.p - (surface - kAbove * nhat)).norm();
  const Vec3 goal = heldByFriction(surface, god, depth, friction_[pair.solid], law_.fraction, contact.slipping);
  if (contact.slipping && !moveTo(at_god, X_WH.q, goal, god, god_nhat)) return false;
  contact.surface_B = X_WB.inverseTimes(surface);
  contact.god_B = X_WB.inverseTimes(god);
  contact.nhat_B = X_WB.q.conjugate() * nhat;
  contact.god_nhat_B = X_WB.q.conjugate() * god_nhat;
  return true;
}

bool PairObjects::touch(const Pose& X_WH, const Touchables& touchables, BoundedList<ToolForce>& forces) noexcept {
  double longest = 0;
  for (const Contact& contact : contacts_) {
    if (contact.touching) longest = std::max(longest, contact.reach);
  }
  const bool whole = pairs_.gather(X_WH, 2 * longest + 2 * kAbove);
  pairs_.separate(X_WH, 2 * kAbove);
  ++tick_;
  const double stiffness = law_.coupling.stiffness;
  for (const NearParts& near : pairs_.near()) {
    NearParts pair = near;
    Contact& contact = contacts_[pairs_.indexOf(pair)];
    const std::int32_t body = bodies_[pair.solid].body;
    const Pose X_WB = touchables.frameOf(body);
    contact.touching = contact.touching ? follow(pair, X_WH, X_WB, contact) : begin(pair, X_WH, X_WB, contact);
    contact.tick = tick_;
    if (!contact.touching) continue;
    const Vec3 nhat = X_WB.q * contact.god_nhat_B, shift = X_WB * contact.god_B - kAbove * nhat - X_WH.p;
    contact.reach = shift.norm();
    forces.add({.body = body,
                .p_W = (pair.on_body_W + pair.on_tool_W) / 2,
                .nhat_W = nhat,
                .f_W = saturated(stiffness * shift, law_.coupling.max_force),
                .stiffness = stiffness,
                .friction_static = friction_[pair.solid].mu_static,
                .friction_dynamic = friction_[pair.solid].mu_dynamic,
                .slips = contact.slipping});
  }
  for (Contact& contact : contacts_) contact.touching = contact.touching && contact.tick == tick_;
  return whole;
}

void PairObjects::letGo() noexcept {
  for (Contact& contact : contacts_) contact = {};
}

}  // namespace presa
