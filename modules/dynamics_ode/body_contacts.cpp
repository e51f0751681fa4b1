#include "modules/dynamics_ode/body_contacts.h"

#include <algorithm>
#include <array>

#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {
namespace {

// contacts closer than this fraction of the body's size, with the same normal, are merged: a sphere on the edge between
// two triangles, or a box reported once per triangle
constexpr double kSamePoint = 1e-3;
constexpr double kSameNormal = 0.999;
// number of contacts that support a body against tipping in any direction
constexpr std::size_t kSupported = 4;
// maximum growth relative to the smaller body: a larger shape would touch the other body on a wrong side
constexpr double kMaxGrowth = 0.2;
// the far end of a tipping body falls faster than g (a rod: 1.5 g)
constexpr double kRim = 2;
constexpr double kSameCorner = 0.01;
// points of a manifold that are kept although they touch nothing yet, so that fewer come and go
constexpr double kNear = 1e-3;
constexpr double kRounding = 1e-6;

// Selects contacts greedily: the deepest first, then always the one farthest from all selected. These span the contact
// area and carry the load. Returns the number of selected contacts, which are moved to the front.
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

std::optional<std::size_t> BodyContacts::collideAwake(const BodySet& bodies, double h,
                                                      std::vector<BodyContact>& contacts) {
  contacts.clear();
  hull_contacts_.beginStep();
  for (const BroadPhase::Pair& pair : broad_phase_.find(bodies, h, kRim * h * h * gravity_.norm())) {
    const std::size_t before = contacts.size();
    collidePair(bodies, pair, foresight_ == Foresight::kNone ? 0 : h, contacts);
    if (contacts.size() == before) continue;
    for (const std::size_t i : {pair.first, pair.second}) {
      if (bodies.asleep(i)) return i;
    }
  }
  return std::nullopt;
}

void BodyContacts::collidePair(const BodySet& bodies, const BroadPhase::Pair& pair, double h,
                               std::vector<BodyContact>& contacts) {
  // ODE's normal points into the first geometry; make that B, which must be a free body
  const std::size_t B = bodies.moves(pair.second) ? pair.second : pair.first;
  const std::size_t A = B == pair.second ? pair.first : pair.second;
  if (bodies.shapes(A).count > 1 || bodies.shapes(B).count > 1) return collideSeveral(bodies, A, B, h, contacts);
  collideShapes(bodies, {A, B, bodies.shapes(A).first, bodies.shapes(B).first}, h, contacts);
}

void BodyContacts::collideSeveral(const BodySet& bodies, std::size_t A, std::size_t B, double h,
                                  std::vector<BodyContact>& contacts) {
  const double margin = std::max(kNear * std::min(bodies.extent(A), bodies.extent(B)), reach(bodies, A, B, h));
  const std::size_t before = contacts.size();
  const BodySet::Shapes low = bodies.shapes(std::min(A, B)), high = bodies.shapes(std::max(A, B));
  inner_edges_.begin();
  for (std::size_t s = low.first; s < low.first + low.count; ++s) {
    for (std::size_t t = high.first; t < high.first + high.count; ++t) {
      if (!bodies.shapesAreNear(s, t, margin)) continue;
      const Meeting of{A, B, A < B ? s : t, A < B ? t : s};
      const std::size_t first = contacts.size();
      collideShapes(bodies, of, h, contacts);
      inner_edges_.add(of.shape_A, of.shape_B, contacts.size() - first);
    }
  }
  inner_edges_.remove(bodies, contacts, before);
}

void BodyContacts::collideShapes(const BodySet& bodies, const Meeting& of, double h,
                                 std::vector<BodyContact>& contacts) {
  const std::size_t before = contacts.size();
  if (collideHulls(bodies, of, h, contacts)) return;
  const double same = kSamePoint * std::min(bodies.extentOf(of.shape_A), bodies.extentOf(of.shape_B));
  report(bodies, of, same, contacts);
  if (h > 0 && contacts.size() < before + kSupported) reportNearing(bodies, of, h, contacts, before);
}

double BodyContacts::reach(const BodySet& bodies, std::size_t A, std::size_t B, double h) const {
  return bodies.reach(A, h) + bodies.reach(B, h) + kRim * h * h * gravity_.norm();
}

// False when they are not both polyhedra.
bool BodyContacts::collideHulls(const BodySet& bodies, const Meeting& of, double h,
                                std::vector<BodyContact>& contacts) {
  const std::size_t A = of.A, B = of.B;
  const double near = h > 0 ? kNear * std::min(bodies.extent(A), bodies.extent(B)) : 0;
  const Manifold* manifold =
      hull_contacts_.find(bodies, of.shape_A, of.shape_B, std::max(near, reach(bodies, A, B, h)));
  if (manifold == nullptr) return false;
  const bool all = foresight_ == Foresight::kAround && !bodies.asleep(A) && !bodies.asleep(B);
  for (int i = 0; i < manifold->count; ++i) {
    const Manifold::Point& point = manifold->points[static_cast<std::size_t>(i)];
    const BodyContact contact{static_cast<std::int32_t>(A), static_cast<std::int32_t>(B), point.p_W,
                              manifold->nhat_AB_W, -point.gap};
    if (all || point.gap <= near || point.gap <= mayClose(bodies, contact, h)) contacts.push_back(contact);
  }
  return true;
}

void BodyContacts::report(const BodySet& bodies, const Meeting& of, double same, std::vector<BodyContact>& contacts) {
  const dGeomID b = parallel_boxes_.standIn(bodies.geom(of.shape_B), bodies.geom(of.shape_A));
  int count = collide(b, bodies.geom(of.shape_A), kMaxReported, reported_);
  const auto useless = [](const dContactGeom& contact) {
    return !(contact.depth >= 0) || !(toVec3(contact.normal).squaredNorm() > 0.25) || !toVec3(contact.pos).allFinite();
  };
  count = static_cast<int>(std::remove_if(reported_, reported_ + count, useless) - reported_);
  if (count == 0) return;
  count = thin(reported_, count, kMaxPerPair, same);
  for (int i = 0; i < count; ++i) {
    const dContactGeom& contact = reported_[i];
    contacts.push_back({static_cast<std::int32_t>(of.A), static_cast<std::int32_t>(of.B), toVec3(contact.pos),
                        toVec3(contact.normal).normalized(), contact.depth});
  }
}

// Approach by the current velocity, plus, if both bodies are awake, the approach caused by gravity within the step.
double BodyContacts::mayClose(const BodySet& bodies, const BodyContact& c, double h) const {
  const auto A = static_cast<std::size_t>(c.A), B = static_cast<std::size_t>(c.B);
  const double closing = -(bodies.pathVelocityAt(B, c.p_W) - bodies.pathVelocityAt(A, c.p_W)).dot(c.nhat_AB_W);
  if (bodies.asleep(A) || bodies.asleep(B)) return h * closing;
  const double pull = -gravity_.dot(c.nhat_AB_W);
  return h * closing + kRim * h * h * std::max(pull, bodies.moves(A) ? -pull : 0);
}

// Adds contacts with a gap for surfaces that do not touch yet but may within the step, so that the approach ends at the
// surface.
void BodyContacts::reportNearing(const BodySet& bodies, const Meeting& of, double h, std::vector<BodyContact>& contacts,
                                 std::size_t first) {
  const std::size_t B = of.shape_B, grown = GrownGeom::possible(bodies.geom(B)) ? B : of.shape_A;
  if (!GrownGeom::possible(bodies.geom(grown))) return;
  const double extent = std::min(bodies.extentOf(of.shape_A), bodies.extentOf(B));
  const double margin = std::min(reach(bodies, of.A, of.B, h), kMaxGrowth * extent);
  const std::size_t touching = contacts.size();
  const GrownGeom geom(bodies.geom(grown), margin);
  report(bodies, of, kSamePoint * extent, contacts);
  const auto nearing = [&](BodyContact& c) {
    geom.takeBack(c.p_W, c.depth, grown == B ? Vec3(-c.nhat_AB_W) : c.nhat_AB_W);
    if (c.depth > kRounding * extent) return false;
    for (std::size_t i = first; i < touching; ++i) {
      if ((contacts[i].p_W - c.p_W).norm() < kSameCorner * extent) return false;
    }
    return -c.depth <= mayClose(bodies, c, h);
  };
  const auto end = std::remove_if(contacts.begin() + static_cast<std::ptrdiff_t>(touching), contacts.end(),
                                  [&](BodyContact& c) { return !nearing(c); });
  contacts.erase(end, contacts.end());
}

}  // namespace presa::ode
