#include "modules/ray/ray_surroundings.h"

#include <algorithm>

namespace presa {
namespace {

constexpr double kBeside = 1e-5;       // gap up to which a place is kept [m]
constexpr double kFocusAhead = 1;      // steps for which a front is focused
constexpr double kEqual = 1e-9;        // distance of points that are one [m]
constexpr double kSamePlace = 1e-3;    // [m]
constexpr double kSameNormal = 0.999;  // cosine

Segment inverseTimes(const Pose& X, const Segment& segment) noexcept {
  return {X.inverseTimes(segment.a), X.inverseTimes(segment.b)};
}

}  // namespace

RayBodies::RayBodies(const World& world) : shapes(convexShapes(world)) {
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    const Body& body = world.scene.bodies[b];
    const BodyMeshes& own = world.meshes[b];
    if (!body.haptic || !std::holds_alternative<MeshRef>(body.haptic->shape) || own.haptic == nullptr) continue;
    auto tree = own.haptic_tree ? own.haptic_tree : std::make_shared<const MeshTree>(own.haptic);
    meshes.push_back({static_cast<std::int32_t>(b), std::move(tree), body.haptic->X_BG});
  }
}

std::vector<std::int32_t> RayBodies::bodies() const {
  std::vector<std::int32_t> all;
  for (const ConvexSolid& shape : shapes) all.push_back(shape.body);
  for (const Mesh& mesh : meshes) all.push_back(mesh.body);
  return all;
}

RaySurroundings::RaySurroundings(const Ray& ray, const ConvexSolid& tool, const RayBodies& bodies)
    : ray_(ray), bodies_(bodies), pairs_(tool, bodies.shapes), places_(kPlaces) {
  const std::size_t slots = std::min(kMaxMeshes, bodies.meshes.size());
  for (std::size_t i = 0; i < slots; ++i) near_.push_back(std::make_unique<Near>());
  now_.resize(slots);
}

void RaySurroundings::place(const Touchables& touchables, const std::vector<Pose>& X_WB) noexcept {
  pairs_.place(touchables);
  X_WB_ = &X_WB;
  ++tick_;
}

void RaySurroundings::forget() noexcept {
  pairs_.forget();
  places_.clear();
}

// The slot that was not used for longest; null: all are in use in this step.
RaySurroundings::Near* RaySurroundings::nearOf(std::size_t mesh) noexcept {
  Near* oldest = nullptr;
  for (const auto& one : near_) {
    if (one->used && one->mesh == mesh) return one.get();
    if (one->tick < tick_ && (oldest == nullptr || one->tick < oldest->tick)) oldest = one.get();
  }
  if (oldest == nullptr) return nullptr;
  for (std::size_t i = places_.size(); i-- > 0;) {
    if (near_[places_[i].near].get() == oldest) places_.remove(i);
  }
  oldest->used = true;
  oldest->mesh = mesh;
  oldest->front.seed(*bodies_.meshes[mesh].tree);
  return oldest;
}

bool RaySurroundings::begin(const Pose& X_WT, double reach) noexcept {
  q_begin_ = X_WT.q;
  reach_ = reach;
  whole_ = pairs_.gather(X_WT, reach);
  now_count_ = 0;
  const Segment axis_W = ray_.axisAt(X_WT);
  for (std::size_t m = 0; m < bodies_.meshes.size(); ++m) {
    const RayBodies::Mesh& mesh = bodies_.meshes[m];
    const Pose X_WG = (*X_WB_)[bodies_.shapes.size() + m] * mesh.X_BG;
    const Segment axis = inverseTimes(X_WG, axis_W);
    const Vec3& centre = mesh.tree->sphereCenter();
    const double apart = (centre - closestOnSegment(centre, axis.a, axis.b)).norm();
    if (apart > mesh.tree->sphereRadius() + ray_.radius + reach) continue;
    Near* near = nearOf(m);
    if (near == nullptr) {
      whole_ = false;
      continue;
    }
    near->tick = tick_;
    near->X_WG = X_WG;
    near->front.focus(axis, ray_.radius + reach, kFocusAhead * reach);
    const auto slot = std::find_if(near_.begin(), near_.end(), [&](const auto& one) { return one.get() == near; });
    now_[now_count_++] = static_cast<std::size_t>(slot - near_.begin());
  }
  return !pairs_.near().empty() || now_count_ > 0;
}

void RaySurroundings::look(const Pose& X_WT, BoundedList<PressedPoint>& points) noexcept {
  points.clear();
  clearance_ = ray_.radius + reach_;
  lookAtShapes(X_WT, points);
  for (std::size_t i = 0; i < now_count_; ++i) lookAtMesh(now_[i], X_WT, points);
}

void RaySurroundings::lookAtShapes(const Pose& X_WT, BoundedList<PressedPoint>& points) noexcept {
  pairs_.separate(X_WT, reach_);
  for (const NearParts& pair : pairs_.near()) {
    clearance_ = std::min(clearance_, std::max(0.0, pair.gap + ray_.radius));
    if (pair.gap > reach_) continue;
    Manifold manifold;
    pairs_.touch(pair, reach_, manifold);
    for (int i = 0; i < manifold.count; ++i) {
      const Manifold::Point& point = manifold.points[static_cast<std::size_t>(i)];
      addDeepest({.p = q_begin_ * (X_WT.q.conjugate() * (point.p_W - X_WT.p)),
                  .nhat = pair.nhat_W,
                  .gap = point.gap,
                  .pair = pair.solid,
                  .solid = pair.solid},
                 points);
    }
  }
}

void RaySurroundings::lookAtMesh(std::size_t slot, const Pose& X_WT, BoundedList<PressedPoint>& points) noexcept {
  Near& near = *near_[slot];
  const Segment axis = inverseTimes(near.X_WG, ray_.axisAt(X_WT));
  const SegmentFront::Found found = near.front.nearestOf(axis, ray_.radius + reach_);
  whole_ = whole_ && !near.front.full();
  const Place* newest = nullptr;
  if (found.ref != SegmentFront::kNothing) {
    clearance_ = std::min(clearance_, found.at.distance);
    Place* known = std::find_if(places_.begin(), places_.end(),
                                [&](const Place& one) { return one.near == slot && one.ref == found.ref; });
    if (known == places_.end()) known = SegmentFront::isTriangle(found.ref) ? places_.add() : nullptr;
    if (known != nullptr) {
      *known = {slot, found.ref, found.at};
      newest = known;
    } else if (SegmentFront::isTriangle(found.ref)) {
      whole_ = false;
    } else {
      add(found.at, near, points);
    }
  }
  for (Place& one : places_) {
    if (one.near != slot) continue;
    const PreparedTriangle triangle = near.front.triangleOf(one.ref);
    if (&one != newest) one.at = nearest(axis, triangle);
    const SegmentTouches touches = touchesOf(axis, triangle, one.at);
    for (int i = 0; i < touches.count; ++i) add(touches.place[static_cast<std::size_t>(i)], near, points);
  }
}

// Triangles that share an edge or a corner are held at the same place.
void RaySurroundings::add(const SegmentNearest& at, const Near& near, BoundedList<PressedPoint>& points) noexcept {
  const auto solid = static_cast<std::uint32_t>(bodies_.shapes.size() + near.mesh);
  const Vec3 on_ray = ray_.axis_T.at(at.s), nhat_W = near.X_WG.q * at.nhat;
  const Vec3 p = q_begin_ * on_ray - ray_.radius * nhat_W;
  const bool is_known = std::any_of(points.begin(), points.end(), [&](const PressedPoint& one) {
    return one.solid == solid && (one.p - p).squaredNorm() < kEqual * kEqual;
  });
  if (is_known) return;
  addDeepest({.p = p, .nhat = nhat_W, .gap = at.distance - ray_.radius, .pair = solid, .solid = solid}, points);
}

// On a fine mesh many triangles touch at one place; the deepest stands for all.
void RaySurroundings::keep() noexcept {
  for (std::size_t i = places_.size(); i-- > 0;) {
    if (places_[i].at.distance - ray_.radius > kBeside) places_.remove(i);
  }
  if (places_.size() < 2) return;
  const double length = (ray_.axis_T.b - ray_.axis_T.a).norm();
  for (std::size_t i = places_.size(); i-- > 0;) {
    const Place& own = places_[i];
    const bool is_same = std::any_of(places_.begin(), places_.end(), [&](const Place& other) {
      return other.near == own.near && other.at.distance < own.at.distance &&
             std::abs(other.at.s - own.at.s) * length < kSamePlace && other.at.nhat.dot(own.at.nhat) > kSameNormal;
    });
    if (is_same) places_.remove(i);
  }
}

}  // namespace presa
