#include "framework/haptics/sticking.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace presa {
namespace {

constexpr double kRounding = 1e-9;  // of the limit of friction
constexpr double kSoft = 0.1;  // of the spring of a pair that holds, up to which a spring is one that slides steadily
constexpr double kMissed = 0.02;  // of the limit of friction, by which friction in the problem may be wrong

Vec3 along(const PressedPoint& contact, const Vec3& v) noexcept { return v - v.dot(contact.nhat) * contact.nhat; }

/// Way of the point along the surface in the step.
Vec3 slip(const PressedPoint& contact, const Vec6& u) noexcept {
  return along(contact, u.head<3>() + Vec3(u.tail<3>()).cross(contact.p));
}

}  // namespace

const Sticking::Anchor* Sticking::anchorOf(const PressedPoint& contact) const noexcept {
  const auto* found =
      std::find_if(anchors_.begin(), anchors_.end(), [&](const Anchor& one) { return one.pair == contact.pair; });
  return found == anchors_.end() ? nullptr : found;
}

Sticking::Anchor* Sticking::anchorOf(const PressedPoint& contact) noexcept {
  return const_cast<Anchor*>(std::as_const(*this).anchorOf(contact));
}

bool Sticking::slides(const PressedPoint& contact) const noexcept {
  const Anchor* anchor = anchorOf(contact);
  return anchor != nullptr && anchor->slides;
}

void Sticking::begin(bool steady) noexcept {
  for (Anchor& anchor : anchors_) {
    anchor.slid = anchor.slides;
    const double stretch = anchor.pressure > 0 ? anchor.stretched / anchor.pressure : 0;
    anchor.slides = anchor.is_spring = steady && anchor.slid && anchor.limit < kSoft * stiffness_ * stretch;
  }
}

Vec3 Sticking::stretchOf(const PressedPoint& contact, const Anchor& anchor, const StepPoses& poses) noexcept {
  const Vec3 p_T = poses.X_WT.q.conjugate() * contact.p;
  const Vec3 held_W = poses.X_WB[contact.solid] * (anchor.X_BT * p_T);
  return along(contact, poses.X_WT.p + contact.p - held_W);
}

void Sticking::addTo(ContactProblem& problem, const StepPoses& poses, BoundedList<PressedPoint>& contacts) noexcept {
  for (Anchor& anchor : anchors_) {
    anchor.pressure = 0;
    anchor.holds = anchor.is_spring;
  }
  for (const PressedPoint& one : contacts) {
    if (Anchor* anchor = anchorOf(one)) anchor->pressure += one.force;
  }
  for (PressedPoint& one : contacts) {
    const double before = one.hold;
    one.hold = 0;
    Anchor* anchor = anchorOf(one);
    if (anchor == nullptr || !(one.force > 0)) continue;
    Vec3 force = one.friction;
    if (!anchor->slides || (anchor->is_spring && one.stretch > 0)) {
      one.hold = stiffness_ * one.force / anchor->pressure;
      if (anchor->slides) {
        double weaker = friction_[one.solid].mu_dynamic * one.force / one.stretch;
        if (before > 0) weaker *= std::sqrt(weaker / before);  // a step and a half at once
        anchor->holds = anchor->holds && weaker >= one.hold;
        one.hold = std::min(one.hold, weaker);
      }
      force = -one.hold * stretchOf(one, *anchor, poses);
      problem.inverse = nullptr;
      addStiffness(one.hold * (Mat3::Identity() - one.nhat * one.nhat.transpose()), one.p, problem.Q);
    }
    problem.r.head<3>() += force;
    problem.r.tail<3>() += one.p.cross(force);
  }
}

void Sticking::slide(const Vec6& u, const StepPoses& poses, BoundedList<PressedPoint>& contacts) const noexcept {
  for (PressedPoint& one : contacts) {
    const Anchor* anchor = anchorOf(one);
    if (anchor == nullptr || !anchor->slides || !(one.force > 0)) continue;
    if (anchor->is_spring && anchor->stretched > 0 && anchor->pressure > 0) {
      one.stretch = anchor->stretched / anchor->pressure;
      continue;
    }
    const Vec3 stretch = stretchOf(one, *anchor, poses) + slip(one, u);
    one.stretch = stretch.norm();
    if (one.stretch > 0) one.friction = -friction_[one.solid].mu_dynamic * one.force / one.stretch * stretch;
  }
}

bool Sticking::update(const Vec6& u, const StepPoses& poses, BoundedList<PressedPoint>& contacts) noexcept {
  for (Anchor& anchor : anchors_) anchor.pressure = anchor.limit = anchor.wanted = anchor.stretched = anchor.missed = 0;
  for (PressedPoint& one : contacts) {
    const Vec3 given = one.friction;
    one.friction = Vec3::Zero();
    Anchor* anchor = anchorOf(one);
    // a point that the spring lifted still holds the pair by its part of the spring, until the next round
    if (anchor == nullptr || !(one.force > 0 || one.hold > 0)) continue;
    const FrictionCoefficients& friction = friction_[one.solid];
    anchor->pressure += one.force;
    anchor->limit += (anchor->slid ? friction.mu_dynamic : friction.mu_static) * one.force;
    const Vec3 stretch = stretchOf(one, *anchor, poses) + slip(one, u);
    one.stretch = stretch.norm();
    anchor->stretched += one.force * one.stretch;
    one.friction = -one.hold * stretch;
    anchor->wanted += one.friction.norm();
    if (!anchor->slides || !(one.stretch > 0)) continue;
    const Vec3 slides = -friction.mu_dynamic * one.force / one.stretch * stretch;
    anchor->missed += (slides - (one.hold > 0 ? one.friction : given)).norm();
    if (!(one.hold > 0)) one.friction = slides;
  }
  bool as_thought = true;
  for (Anchor& anchor : anchors_) {
    if (anchor.slides && anchor.is_spring && anchor.holds) {
      anchor.slides = anchor.wanted > anchor.limit * (1 + kRounding);
      if (!anchor.slides) continue;
      anchor.is_spring = false;
      as_thought = false;
    } else if (anchor.slides && anchor.missed > kMissed * anchor.limit) {
      anchor.is_spring = true;
      as_thought = false;
    }
    if (anchor.slides || anchor.wanted <= anchor.limit * (1 + kRounding)) continue;
    anchor.slides = true;
    as_thought = false;
  }
  if (as_thought) return true;
  for (PressedPoint& one : contacts) {
    const Anchor* anchor = anchorOf(one);
    if (anchor == nullptr || !anchor->slides || !(one.friction.norm() > 0)) continue;
    one.friction *= friction_[one.solid].mu_dynamic * one.force / one.friction.norm();
  }
  return false;
}

void Sticking::keep(const Pose& X_WT, const StepPoses& poses, const BoundedList<PressedPoint>& contacts) noexcept {
  for (Anchor& anchor : anchors_) {
    if (!anchor.slides) continue;
    // the anchor follows at the distance at which the spring of friction has its dynamic limit
    const double limit = friction_[anchor.solid].mu_dynamic * anchor.pressure * anchor.pressure,
                 part = std::min(1.0, limit / (stiffness_ * anchor.stretched));
    const Pose X_BT = poses.X_WB[anchor.solid].inverse() * X_WT;
    anchor.X_BT = {X_BT.p + part * (anchor.X_BT.p - X_BT.p), X_BT.q.slerp(part, anchor.X_BT.q)};
  }
  for (std::size_t i = anchors_.size(); i-- > 0;) {
    if (!(anchors_[i].pressure > 0)) anchors_.remove(i);
  }
  for (const PressedPoint& one : contacts) {
    if (!(one.force > 0) || anchorOf(one) != nullptr) continue;
    anchors_.add(
        {.pair = one.pair, .solid = one.solid, .X_BT = poses.X_WB[one.solid].inverse() * X_WT, .pressure = one.force});
  }
}

bool solveWithFriction(const ContactProblem& without, const StepPoses& poses, Sticking& sticking,
                       BoundedList<PressedPoint>& contacts, Vec6& u) noexcept {
  constexpr int kRounds = 12;  // in which pairs that hold turn out to slide, and the springs of those find their force
  bool exact = solveContacts(without, contacts, u).exact, as_thought = false;
  sticking.slide(u, poses, contacts);
  for (int round = 0; round < kRounds && !as_thought; ++round) {
    ContactProblem problem = without;
    sticking.addTo(problem, poses, contacts);
    exact = solveContacts(problem, contacts, u).exact && exact;
    as_thought = sticking.update(u, poses, contacts);
  }
  return exact && as_thought;
}

}  // namespace presa
