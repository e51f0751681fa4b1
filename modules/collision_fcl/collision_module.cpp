#include "modules/collision_fcl/collision_module.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "modules/collision_fcl/reach.h"

namespace presa {
namespace {

/// A neighbourhood is made larger than needed by this factor, so that it serves for several queries. Only where its
/// size costs nothing: a cut of the tree has at most 16 nodes, but the other indices visit each triangle within reach.
constexpr double kFarther = 1.5;

std::size_t touchableCount(const World& world) {
  return static_cast<std::size_t>(
      std::ranges::count_if(world.scene.bodies, [](const Body& body) { return body.haptic.has_value(); }));
}

using Index = CollisionSettings::Index;

/// Triangles of the largest touchable mesh; 0 where no index needs them.
std::size_t facetRoom(const World& world) {
  std::size_t most = 0;
  for (const BodyMeshes& meshes : world.meshes) {
    if (meshes.haptic_tree) most = std::max(most, meshes.haptic_tree->mesh().triangles.size());
  }
  return world.scene.collision.index == Index::kTree ? 0 : most;
}

std::string how(Index index) {
  switch (index) {
    case Index::kObb:
      return ", around the triangles that a tree of oriented boxes finds (index=\"obb\")";
    case Index::kHcollide:
      return ", around the triangles that a hashed grid of trees of oriented boxes finds (index=\"hcollide\")";
    case Index::kTree:
      break;
  }
  return "";
}

bool same(const Pose& a, const Pose& b) { return a.p == b.p && a.q.coeffs() == b.q.coeffs(); }

}  // namespace

CollisionModule::CollisionModule(std::shared_ptr<const World> world)
    : Module("collision_fcl", RateGroup::kCollision),
      world_(std::move(world)),
      dynamics_period_(1 / world_->scene.rates.dynamics),
      broad_phase_(touchableCount(*world_)),
      facets_(facetRoom(*world_)) {
  for (std::size_t b = 0; b < world_->scene.bodies.size(); ++b) {
    const Body& body = world_->scene.bodies[b];
    touchable_of_.push_back(-1);
    if (!body.haptic) continue;
    Touchable touchable;
    touchable.body = static_cast<std::int32_t>(b);
    touchable.X_BG = body.haptic->X_BG;
    touchable.moves = !body.fixed;
    touchable.X_WB = body.X_WB;
    if (std::holds_alternative<MeshRef>(body.haptic->shape)) {
      const auto& tree = world_->meshes[b].haptic_tree;
      if (!tree) throw std::invalid_argument("a haptic mesh needs its hierarchy");
      touchable.tree = tree.get();
      if (world_->scene.collision.index != Index::kTree) {
        std::unique_ptr<MeshIndex>& index = indices_[tree.get()];
        if (!index) index = makeMeshIndex(world_->scene.collision.index, *tree);
        touchable.index = index.get();
      }
      touchable.center_B = body.haptic->X_BG * tree->sphereCenter();
      touchable.radius = tree->sphereRadius();
    } else {
      touchable.center_B = body.haptic->X_BG.p;
      touchable.radius = boundingRadius(body.haptic->shape);
    }
    any_moves_ = any_moves_ || touchable.moves;
    touchable_of_.back() = static_cast<std::int32_t>(touchables_.size());
    touchables_.push_back(touchable);
    broad_phase_.place(touchables_.size() - 1, touchable.X_WB * touchable.center_B, touchable.radius);
  }
  broad_phase_.refresh();
  found_.reserve(touchables_.size());
  finger_neighbourhoods.value.fingers.resize(world_->scene.devices.size());
  last_W_.assign(world_->scene.devices.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
}

void CollisionModule::step(const Tick& tick) noexcept {
  FingerNeighbourhoods& neighbourhoods = finger_neighbourhoods.value;
  neighbourhoods.time = tick.time;
  neighbourhoods.count = std::min(device_state->count(), static_cast<std::int32_t>(neighbourhoods.fingers.size()));
  if (any_moves_) placeBodies(tick);
  for (std::size_t f = 0; f < static_cast<std::size_t>(neighbourhoods.count); ++f) {
    const Ball needed = ballOf(f, tick);
    if (!lastNeighbourhoodServes(f, needed)) makeNeighbourhood(needed, last_W_[f], neighbourhoods.fingers[f]);
    last_W_[f] = needed.center_W;
  }
}

// A neighbourhood is made from poses at the start of a collision period, published at the latest at its end, and used
// until the next one.
double CollisionModule::horizon(const Tick& tick) const noexcept {
  return reach::kCollisionPeriods * tick.period + reach::kDynamicsPeriods * dynamics_period_ +
         std::max(device_state.age(tick), 0.0);
}

void CollisionModule::placeBodies(const Tick& tick) noexcept {
  const double ahead = horizon(tick);
  for (std::size_t t = 0; t < touchables_.size(); ++t) {
    Touchable& touchable = touchables_[t];
    if (!touchable.moves) continue;
    double speed = 0;
    Pose X_WB = touchable.X_WB;
    if (object_state.hasValue() && touchable.body < object_state->count()) {
      const BodyMotion& motion = object_state->bodies[static_cast<std::size_t>(touchable.body)];
      X_WB = object_state->poseAt(touchable.body, tick.time);
      speed = motion.v_WB.norm() + motion.w_WB.norm() * touchable.center_B.norm();
    }
    const double travel = reach::travel(speed, ahead);
    if (touchable.travel == travel && same(touchable.X_WB, X_WB)) continue;
    touchable.X_WB = X_WB;
    touchable.travel = travel;
    broad_phase_.place(t, X_WB * touchable.center_B, touchable.radius + travel);
  }
  broad_phase_.refresh();
}

CollisionModule::Ball CollisionModule::ballOf(std::size_t finger, const Tick& tick) const noexcept {
  const FingerInput& input = device_state->fingers[finger];
  double stretch = 0;
  if (contact_exchange.hasValue() && static_cast<int>(finger) < contact_exchange->count()) {
    const double length = (contact_exchange->fingers[finger].p_WP - input.p_WH).norm();
    if (std::isfinite(length)) stretch = length;
  }
  const double min = stretch + reach::kFingertips * world_->scene.devices[finger].fingertip_radius;
  if (world_->scene.collision.margin > 0) return {input.p_WH, min + world_->scene.collision.margin};
  const double extra = world_->scene.collision.index == Index::kTree ? reach::kMargin : 0;
  return {input.p_WH, min + extra + reach::travel(input.v_WH.norm(), horizon(tick))};
}

bool CollisionModule::lastNeighbourhoodServes(std::size_t finger, const Ball& needed) noexcept {
  const FingerNeighbourhood& neighbourhood = finger_neighbourhoods.value.fingers[finger];
  // written so that a position with NaN is never served
  if (neighbourhood.serial == 0 ||
      !((needed.center_W - neighbourhood.center_W).norm() + needed.radius <= neighbourhood.radius))
    return false;
  if (!any_moves_) return true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(neighbourhood.body_count); ++i) {
    const NearBody& near = neighbourhood.bodies[i];
    if (near.cut_count == 0) continue;
    const Touchable& touchable =
        touchables_[static_cast<std::size_t>(touchable_of_[static_cast<std::size_t>(near.body)])];
    const Vec3 center_B = touchable.X_WB.inverseTimes(needed.center_W);
    if ((center_B - near.center_B).norm() + needed.radius > near.radius) return false;
  }
  broad_phase_.near(neighbourhood.center_W, neighbourhood.radius, found_);
  const auto* end = neighbourhood.bodies.data() + neighbourhood.body_count;
  return std::ranges::all_of(found_, [&](std::int32_t t) {
    const std::int32_t body = touchables_[static_cast<std::size_t>(t)].body;
    return std::find_if(neighbourhood.bodies.data(), end, [&](const NearBody& near) { return near.body == body; }) !=
           end;
  });
}

void CollisionModule::makeNeighbourhood(const Ball& needed, const Vec3& last_W,
                                        FingerNeighbourhood& neighbourhood) noexcept {
  const bool fixed = world_->scene.collision.margin > 0 || world_->scene.collision.index != Index::kTree;
  neighbourhood.serial = ++serial_;
  neighbourhood.center_W = needed.center_W;
  neighbourhood.radius = fixed ? needed.radius : kFarther * needed.radius;
  neighbourhood.body_count = 0;
  if (!neighbourhood.center_W.allFinite()) {
    neighbourhood.radius = -1;
    return;
  }
  broad_phase_.near(neighbourhood.center_W, neighbourhood.radius, found_);
  if (found_.size() > neighbourhood.bodies.size()) {  // too many: the haptic tick examines all bodies itself
    neighbourhood.radius = -1;
    return;
  }
  for (const std::int32_t t : found_) {
    const Touchable& touchable = touchables_[static_cast<std::size_t>(t)];
    NearBody& near = neighbourhood.bodies[static_cast<std::size_t>(neighbourhood.body_count++)];
    near.body = touchable.body;
    near.cut_count = 0;
    if (touchable.tree == nullptr) continue;
    near.center_B = touchable.X_WB.inverseTimes(neighbourhood.center_W);
    near.radius = neighbourhood.radius + std::max(touchable.travel, 0.0);
    near.cut_count = static_cast<std::int32_t>(cutOf(touchable, last_W, near));
  }
}

std::size_t CollisionModule::cutOf(const Touchable& touchable, const Vec3& last_W, NearBody& near) noexcept {
  const Vec3 center_G = touchable.X_BG.inverseTimes(near.center_B);
  if (touchable.index == nullptr) return touchable.tree->cut(center_G, near.radius, near.cut);
  const Vec3 last_G = touchable.X_BG.inverseTimes(touchable.X_WB.inverseTimes(last_W));
  facets_.clear();
  touchable.index->find({last_G.allFinite() ? last_G : center_G, center_G, near.radius}, facets_);
  return cutAround(facets_, *touchable.tree, near.cut);
}

std::vector<std::string> CollisionModule::stages() const {
  const char* margin = world_->scene.collision.margin > 0 ? "the scene's margin" : "a motion bound";
  return {
      "place the bodies that have moved in the broad phase (FCL's dynamic tree of boxes)",
      std::string(
          "check whether each finger's last neighbourhood still covers its reach: fingertip, proxy displacement and ") +
          margin,
      "bodies within reach, and a cut through the hierarchy of each mesh among them" +
          how(world_->scene.collision.index)};
}

}  // namespace presa
