#include "modules/dynamics_ode/convex/hull_contacts.h"

#include <algorithm>

namespace presa::ode {
namespace {

constexpr std::size_t kPairsPerShape = 16;
constexpr double kBroad = 8;  // size of a body on which a cylinder meets faces, not corners, in relation to it

double radiusOf(const Hull& hull) {
  double radius = 0;
  for (const Vec3& v : hull.vertices) radius = std::max(radius, (v - hull.centre).norm());
  return radius + hull.radius;
}

}  // namespace

// Between the corner that it turns to the other body and the next a prism is flatter than its cylinder, by up to 8 % of
// the radius: a block's corner would sink in there.
bool HullContacts::collides(const Hull& A, const Hull& B) {
  if (A.cylinder && B.cylinder) return false;
  if (A.cylinder) return radiusOf(B) > kBroad * radiusOf(A);
  return !B.cylinder || radiusOf(A) > kBroad * radiusOf(B);
}

HullContacts::HullContacts(const BodySet& bodies) : placed_(bodies.shapeCount()) {
  std::size_t edges = 0, faces = 0;
  for (std::size_t i = 0; i < bodies.shapeCount(); ++i) {
    if (bodies.hullOf(i) == nullptr) continue;
    edges = std::max(edges, bodies.hullOf(i)->edges.size());
    faces = std::max(faces, bodies.hullOf(i)->faces.size());
    placed(bodies, i);  // takes its memory
  }
  maker_.makeRoom(edges, faces);
  memories_.reserve(kPairsPerShape * bodies.shapeCount());
  past_.reserve(kPairsPerShape * bodies.shapeCount());
}

void HullContacts::beginStep() {
  ++step_;
  std::swap(memories_, past_);
  memories_.clear();
  recalled_ = 0;
}

const Hull& HullContacts::placed(const BodySet& bodies, std::size_t i) {
  Placed& placed = placed_[i];
  if (placed.step != step_) {
    place(*bodies.hullOf(i), bodies.poseOf(i), placed.hull);
    placed.step = step_;
  }
  return placed.hull;
}

// Shapes ascend with bodies, so the lower shape is of the lower body.
HullContacts::Pair HullContacts::pairOf(const BodySet& bodies, std::size_t A, std::size_t B) {
  const auto joined = [](std::uint64_t a, std::uint64_t b) { return a << 32U | b; };
  const auto [low, high] = std::minmax(A, B);
  return {joined(bodies.bodyOf(low), bodies.bodyOf(high)), joined(low, high)};
}

const Manifold* HullContacts::find(const BodySet& bodies, std::size_t A, std::size_t B, double margin) {
  const Hull *hull_A = bodies.hullOf(A), *hull_B = bodies.hullOf(B);
  if (hull_A == nullptr || hull_B == nullptr || !collides(*hull_A, *hull_B)) return nullptr;
  Memory memory{pairOf(bodies, A, B), {}, {}};
  while (recalled_ < past_.size() && past_[recalled_].pair < memory.pair) ++recalled_;
  if (recalled_ < past_.size() && past_[recalled_].pair == memory.pair) memory = past_[recalled_];
  const auto side = [&](std::size_t i, CylinderTurn& turn) {
    const Hull& hull = *bodies.hullOf(i);
    return FacingHulls::Side{hull, bodies.poseOf(i), hull.cylinder ? nullptr : &placed(bodies, i), &turn};
  };
  const bool ascending = A < B;
  const auto [a, b] = facing_.of(side(A, memory.turns[ascending ? 0 : 1]), side(B, memory.turns[ascending ? 1 : 0]));
  maker_.collide(*a, *b, margin, memory.axis, manifold_);
  if (memory.axis.kind != ContactAxis::Kind::kNone) memories_.push_back(memory);
  return &manifold_;
}

}  // namespace presa::ode
