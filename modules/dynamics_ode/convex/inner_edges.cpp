#include "modules/dynamics_ode/convex/inner_edges.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/convex_contact/nearest.h"

namespace presa::ode {
namespace {

constexpr std::size_t kMeetingsPerShape = 4;
constexpr double kNearby = 1e-3;           // in relation to the smaller body: steps of a seam, distance of equal points
constexpr double kSameDirection = 1e-9;    // 1 - cosine of the normals of contacts in one plane
constexpr double kMergedDirection = 1e-3;  // of equal contacts

/// Support in the unit direction nhat_W: max of nhat_W . p_W.
double supportIn(const Hull& hull, const Pose& X_WG, const Vec3& nhat_W) {
  const Vec3 n = X_WG.q.conjugate() * nhat_W;
  const double offset = X_WG.p.dot(nhat_W);
  if (hull.cylinder) {
    return offset + hull.cylinder->radius * std::hypot(n.x(), n.y()) + hull.cylinder->length / 2 * std::abs(n.z());
  }
  double farthest = -1e300;
  for (const Vec3& v : hull.vertices) farthest = std::max(farthest, n.dot(v));
  return offset + farthest + hull.radius;
}

/// Distance of a point from a hull, or from its nearest face plane where that is less; negative inside.
double distanceFrom(const Hull& hull, const Pose& X_WG, const Vec3& p_W) {
  const Vec3 p = X_WG.inverseTimes(p_W);
  if (hull.cylinder) {
    return std::max(std::hypot(p.x(), p.y()) - hull.cylinder->radius, std::abs(p.z()) - hull.cylinder->length / 2);
  }
  if (hull.faces.empty())
    return (p - closestOnSegment(p, hull.vertices.front(), hull.vertices.back())).norm() - hull.radius;
  double farthest = -1e300;
  for (const Hull::Face& face : hull.faces) farthest = std::max(farthest, face.nhat.dot(p) - face.offset);
  return farthest;
}

/// Whether a normal of `with` keeps shapes A and B apart as far as it keeps its own.
bool keepsApart(const BodySet& bodies, const BodyContact& with, std::size_t A, std::size_t B, double near) {
  const Hull *a = bodies.hullOf(A), *b = bodies.hullOf(B);
  if (a == nullptr || b == nullptr) return false;
  const double gap =
      -supportIn(*b, bodies.poseOf(B), -with.nhat_AB_W) - supportIn(*a, bodies.poseOf(A), with.nhat_AB_W);
  return gap >= -with.depth - near;
}

}  // namespace

InnerEdges::InnerEdges(const BodySet& bodies) {
  std::size_t most = 1;
  for (std::size_t i = 0; i < bodies.size(); ++i) most = std::max(most, bodies.shapes(i).count);
  if (most == 1) return;
  meetings_.reserve(kMeetingsPerShape * most);
  candidates_.reserve(kContactsPerBody * most);
  outline_.makeRoom(kContactsPerBody * most);
}

// All contacts of one manifold go or stay together.
bool InnerEdges::meetsJoint(const BodySet& bodies, const std::vector<BodyContact>& contacts, const Candidate& one,
                            const Meeting& other, double near) const {
  const Meeting& own = meetings_[one.meeting];
  const Vec3& nhat = contacts[one.contact].nhat_AB_W;
  const auto touches = [&](std::size_t shape, const Vec3& p_W) {
    const Hull* hull = bodies.hullOf(shape);
    return hull != nullptr && distanceFrom(*hull, bodies.poseOf(shape), p_W) < near;
  };
  for (const Candidate& same : candidates_) {
    if (same.meeting != one.meeting) continue;
    const BodyContact& c = contacts[same.contact];
    if (c.nhat_AB_W.dot(nhat) < 1 - kSameDirection) continue;
    if (own.shape_A != other.shape_A && touches(other.shape_A, c.p_W + c.depth / 2 * nhat)) return true;
    if (own.shape_B != other.shape_B && touches(other.shape_B, c.p_W - c.depth / 2 * nhat)) return true;
  }
  return false;
}

bool InnerEdges::isNeedless(const BodySet& bodies, const std::vector<BodyContact>& contacts, const Candidate& one,
                            const Candidate& other, double near) const {
  if (one.meeting == other.meeting) return false;
  const BodyContact &c = contacts[one.contact], &by = contacts[other.contact];
  const double cosine = c.nhat_AB_W.dot(by.nhat_AB_W);
  if (cosine > 1 - kMergedDirection && (c.p_W - by.p_W).norm() < near) return true;
  if (cosine > 1 - kSameDirection) return false;
  const Meeting& own = meetings_[one.meeting];
  return keepsApart(bodies, by, own.shape_A, own.shape_B, near) &&
         meetsJoint(bodies, contacts, one, meetings_[other.meeting], near);
}

void InnerEdges::remove(const BodySet& bodies, std::vector<BodyContact>& contacts, std::size_t first) {
  if (meetings_.size() < 2) return;
  candidates_.clear();
  std::size_t next = first;
  for (std::uint32_t m = 0; m < meetings_.size(); ++m) {
    for (std::size_t k = 0; k < meetings_[m].contacts; ++k) candidates_.push_back({next++, m, true});
  }
  const auto deeper = [&](const Candidate& a, const Candidate& b) {
    const double depth_a = contacts[a.contact].depth, depth_b = contacts[b.contact].depth;
    return depth_a > depth_b || (depth_a == depth_b && a.contact < b.contact);
  };
  std::sort(candidates_.begin(), candidates_.end(), deeper);
  const BodyContact& any = contacts[first];
  const double near = kNearby * std::min(bodies.extent(static_cast<std::size_t>(any.A)),
                                         bodies.extent(static_cast<std::size_t>(any.B)));
  // the deepest first, since only a deeper contact keeps others apart; then back, for those as deep
  const auto look = [&](std::size_t i, std::size_t end) {
    for (std::size_t k = 0; k < end && candidates_[i].stays; ++k) {
      if (k == i || !candidates_[k].stays) continue;
      candidates_[i].stays = !isNeedless(bodies, contacts, candidates_[i], candidates_[k], near);
    }
  };
  for (std::size_t i = 0; i < candidates_.size(); ++i) look(i, i);
  for (std::size_t i = candidates_.size(); i-- > 0;) look(i, candidates_.size());
  for (const Candidate& candidate : candidates_) {
    if (!candidate.stays) contacts[candidate.contact].B = -1;
  }
  const auto begin = contacts.begin() + static_cast<std::ptrdiff_t>(first);
  contacts.erase(std::remove_if(begin, contacts.end(), [](const BodyContact& c) { return c.B < 0; }), contacts.end());
  outline_.remove(contacts, first, near);
}

}  // namespace presa::ode
