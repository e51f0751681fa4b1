#include "modules/dynamics_ode/body_contacts.h"

#include <algorithm>
#include <array>

#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {
namespace {

// contacts nearer to each other than this part of the body, with the same normal, are one: a sphere on the edge
// between two triangles, a box reported once per triangle
constexpr double kSamePoint = 1e-3;
constexpr double kSameNormal = 0.999;

// Keeps the deepest contact, then again and again the one farthest from all kept: the hull of the touching area, which
// is what carries the load. Returns how many are kept, at the front.
int thin(dContactGeom* contacts, int count, int limit, double same_distance) {
  std::array<double, 64> distance{};
  const auto deeper = [](const dContactGeom& a, const dContactGeom& b) { return a.depth < b.depth; };
  std::iter_swap(contacts, std::max_element(contacts, contacts + count, deeper));
  std::fill_n(distance.begin(), count, 1e300);
  int kept = 1;
  for (; kept < std::min(count, limit); ++kept) {
    const dContactGeom& last = contacts[kept - 1];
    int farthest = kept;
    for (int i = kept; i < count; ++i) {
      const double gap = (toVec3(contacts[i].pos) - toVec3(last.pos)).norm();
      const bool same = gap < same_distance && toVec3(contacts[i].normal).dot(toVec3(last.normal)) > kSameNormal;
      distance[static_cast<std::size_t>(i)] = same ? -1 : std::min(distance[static_cast<std::size_t>(i)], gap);
      if (distance[static_cast<std::size_t>(i)] > distance[static_cast<std::size_t>(farthest)]) farthest = i;
    }
    if (distance[static_cast<std::size_t>(farthest)] < 0) break;
    std::swap(contacts[kept], contacts[farthest]);
    std::swap(distance[static_cast<std::size_t>(kept)], distance[static_cast<std::size_t>(farthest)]);
  }
  return kept;
}

}  // namespace

std::optional<std::size_t> BodyContacts::collideAwake(const BodySet& bodies, std::vector<BodyContact>& contacts) {
  contacts.clear();
  for (const BroadPhase::Pair& pair : broad_phase_.find(bodies)) {
    const std::size_t before = contacts.size();
    collidePair(bodies, pair, contacts);
    if (contacts.size() == before) continue;
    for (const std::size_t i : {pair.first, pair.second}) {
      if (bodies.asleep(i)) return i;
    }
  }
  return std::nullopt;
}

void BodyContacts::collidePair(const BodySet& bodies, const BroadPhase::Pair& pair,
                               std::vector<BodyContact>& contacts) {
  // ODE's normal points into the first geometry: that is B, and B must move
  const std::size_t B = bodies.moves(pair.second) ? pair.second : pair.first;
  const std::size_t A = B == pair.second ? pair.first : pair.second;
  int count = dCollide(bodies.geom(B), bodies.geom(A), kMaxReported, reported_, sizeof(dContactGeom));
  const auto useless = [](const dContactGeom& contact) {
    return !(contact.depth >= 0) || !(toVec3(contact.normal).squaredNorm() > 0.25) || !toVec3(contact.pos).allFinite();
  };
  count = static_cast<int>(std::remove_if(reported_, reported_ + count, useless) - reported_);
  if (count == 0) return;
  count = thin(reported_, count, kMaxPerPair, kSamePoint * std::min(bodies.extent(A), bodies.extent(B)));
  for (int i = 0; i < count; ++i) {
    const dContactGeom& contact = reported_[i];
    contacts.push_back({static_cast<std::int32_t>(A), static_cast<std::int32_t>(B), toVec3(contact.pos),
                        toVec3(contact.normal).normalized(), contact.depth});
  }
}

}  // namespace presa::ode
