#include "modules/dynamics_ode/hit_finder.h"

#include <algorithm>

#include "framework/geometry/index.h"

namespace presa::ode {
namespace {

constexpr double kStopped = 0.95;  // an approach that keeps more of its speed was not stopped
constexpr double kReached = 2e-5;  // gap at which two bodies have met: the solvers leave some [m]

double approachAt(const BodyContact& contact, const BodySet& bodies) {
  const Vec3 v_AB =
      bodies.pathVelocityAt(index(contact.B), contact.p_W) - bodies.pathVelocityAt(index(contact.A), contact.p_W);
  return -v_AB.dot(contact.nhat_AB_W);
}

}  // namespace

void HitFinder::begin(const std::vector<BodyContact>& contacts, const BodySet& bodies) {
  approaches_.clear();
  for (const BodyContact& contact : contacts) approaches_.push_back(approachAt(contact, bodies));
}

void HitFinder::end(const std::vector<BodyContact>& contacts, const BodySet& bodies, double time, double h) {
  BodyHit hit;  // the fastest of a pair; the contacts of a pair follow each other
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const BodyContact& contact = contacts[i];
    if (contact.A != hit.A || contact.B != hit.B) {
      if (hit.speed > 0) hits_.add(hit);
      hit = {.A = contact.A, .B = contact.B};
    }
    const double speed = approaches_[i], gap = std::max(0.0, -contact.depth);
    if (speed < BodyHits::kMinSpeed || speed <= hit.speed || speed * h < gap) continue;
    const double after = approachAt(contact, bodies);
    if (after > kStopped * speed || (after > 0 && gap - after * h > kReached)) continue;
    hit.time = time + gap / speed;
    hit.p_W = contact.p_W;
    hit.nhat_AB_W = contact.nhat_AB_W;
    hit.speed = speed;
  }
  if (hit.speed > 0) hits_.add(hit);
}

}  // namespace presa::ode
