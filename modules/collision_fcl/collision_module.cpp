#include "modules/collision_fcl/collision_module.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "modules/collision_fcl/reach.h"

namespace presa {
namespace {

std::size_t capacityOf(const CollisionSettings& settings) {
  constexpr std::size_t kRoom = kMaxPatchTriangles;
  return settings.max_triangles == 0 ? kRoom : std::min(settings.max_triangles, kRoom);
}

// The mesh's vertices in body coordinates, where those are others than the mesh's own.
std::vector<Vec3> placed(const TriMesh& mesh, const Pose& X_BG) {
  if (X_BG.p == Vec3::Zero() && X_BG.q.coeffs() == Quat::Identity().coeffs()) return {};
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) vertices.push_back(X_BG * vertex);
  return vertices;
}

// How far to look when `needed` must be complete: farther, so that the patch serves for a while, but where the last one was
// full, complete to `held`, not much farther than that (zero: it was not full).
double askedFor(double needed, double held) {
  constexpr double kFarther = 1.5, kGrowth = 1.1;
  const double most = kFarther * needed;
  return held > 0 ? std::clamp(kGrowth * held, needed, most) : most;
}

enum Stage : std::size_t { kPlace, kGather, kDeliver };

}  // namespace

CollisionModule::CollisionModule(std::shared_ptr<const World> world)
    : Module("collision_fcl", RateGroup::kCollision),
      world_(std::move(world)),
      capacity_(capacityOf(world_->scene.collision)),
      dynamics_period_(1 / world_->scene.rates.dynamics) {
  std::map<const TriMesh*, std::shared_ptr<const TriangleIndex>> indices;  // bodies of one mesh share its index
  for (std::size_t b = 0; b < world_->scene.bodies.size(); ++b) {
    const std::shared_ptr<const TriMesh>& mesh = world_->meshes[b].haptic;
    if (!mesh) continue;
    if (mesh->adjacency.size() != mesh->triangles.size())
      throw std::invalid_argument("a haptic mesh needs its adjacency");
    std::shared_ptr<const TriangleIndex>& index = indices[mesh.get()];
    if (!index) index = std::make_shared<TriangleIndex>(mesh);
    const Pose& X_BG = world_->scene.bodies[b].haptic->X_BG;
    mesh_bodies_.push_back({static_cast<std::int32_t>(b), X_BG, index, placed(*mesh, X_BG)});
  }
  candidates_.resize(mesh_bodies_.size());
  for (std::vector<Ball>& known : known_) known.resize(mesh_bodies_.size());
  for (Candidate& candidate : candidates_) candidate.triangles.reserve(capacity_);
  contenders_.reserve(kMaxNearBodies * capacity_);
}

void CollisionModule::step(const Tick& tick) noexcept {
  NoStageWatch nobody;
  stepWatched(tick, nobody);
}

void CollisionModule::stepWatched(const Tick& tick, StageWatch& watch) noexcept {
  ContactPatches& patches = contact_patches.value;
  patches.time = tick.time;
  patches.count = device_state->count;
  for (std::size_t f = 0; f < static_cast<std::size_t>(patches.count); ++f) {
    const bool serves = lastPatchServes(f, tick);
    watch.done(kPlace);
    if (serves) continue;
    gatherAround(f, tick, watch);
    patches.capped_total += keepNearestBodies();
    keepNearestTriangles();
    patches.capped_total += remember(f);
    FingerPatch& patch = patches.fingers[f];
    patch.serial = ++serial_;
    patch.body_count = 0;
    patch.triangle_count = 0;
    for (std::size_t c = 0; c < candidate_count_; ++c) write(candidates_[c], patch);
    watch.done(kDeliver);
  }
}

Pose CollisionModule::poseOf(std::int32_t body, double time) const noexcept {
  if (object_state.hasValue() && body < object_state->count()) return object_state->poseAt(body, time);
  return world_->scene.bodies[static_cast<std::size_t>(body)].X_WB;
}

Vec3 CollisionModule::centerOf(std::size_t finger, std::int32_t body, const Pose& X_WB) const noexcept {
  if (contact_exchange.hasValue() && static_cast<int>(finger) < contact_exchange->count) {
    const FingerContact& contact = contact_exchange->fingers[finger];
    // a proxy in contact moves with its body: its body coordinates are the ones that are still true now
    const Vec3 proxy_B = contact.body == body ? contact.p_BP : X_WB.inverseTimes(contact.p_WP);
    if (proxy_B.allFinite()) return proxy_B;
  }
  return X_WB.inverseTimes(device_state->fingers[finger].p_WH);
}

double CollisionModule::reachOf(std::size_t finger, std::int32_t body, const Pose& X_WB, const Vec3& center_B,
                                const Tick& tick) const noexcept {
  const FingerInput& input = device_state->fingers[finger];
  const double stretch = (input.p_WH - X_WB * center_B).norm();
  const double least = stretch + world_->scene.devices[finger].fingertip_radius;
  if (world_->scene.collision.margin > 0) return least + world_->scene.collision.margin;
  RelativeMotion motion{input.p_WH - X_WB.p, input.v_WH, Vec3::Zero(), Vec3::Zero()};
  if (object_state.hasValue() && body < object_state->count()) {
    const BodyMotion& moving = object_state->bodies[static_cast<std::size_t>(body)];
    motion.v_WB = moving.v_WB;
    motion.w_WB = moving.w_WB;
  }
  const double horizon = reach::kCollisionPeriods * tick.period + reach::kDynamicsPeriods * dynamics_period_ +
                         std::max(device_state.age(tick), 0.0);
  return least + motionBound(motion, horizon) + reach::kMargin;
}

CollisionModule::Ball CollisionModule::neededOn(const MeshBody& mesh_body, std::size_t finger,
                                                const Tick& tick) const noexcept {
  const Pose X_WB = poseOf(mesh_body.body, tick.time);
  const Vec3 center_B = centerOf(finger, mesh_body.body, X_WB);
  const double radius = reachOf(finger, mesh_body.body, X_WB, center_B, tick);
  const Vec3 center_G = mesh_body.X_BG.inverseTimes(center_B);
  const TriangleIndex& index = *mesh_body.index;
  // written so that a position that is not a number is out of reach
  if (!((center_G - index.sphereCenter()).norm() <= index.sphereRadius() + radius)) return {};
  return {center_B, radius};
}

bool CollisionModule::lastPatchServes(std::size_t finger, const Tick& tick) const noexcept {
  for (std::size_t m = 0; m < mesh_bodies_.size(); ++m) {
    const Ball needed = neededOn(mesh_bodies_[m], finger, tick);
    // a body that was in reach and is no more is taken off the list
    if ((needed.radius < 0) != (known_[finger][m].radius < 0)) return false;
    if (needed.radius >= 0 && !known_[finger][m].holds(needed)) return false;
  }
  return contact_patches.value.fingers[finger].serial != 0;
}

void CollisionModule::gatherAround(std::size_t finger, const Tick& tick, StageWatch& watch) noexcept {
  candidate_count_ = 0;
  for (std::size_t m = 0; m < mesh_bodies_.size(); ++m) {
    const MeshBody& mesh_body = mesh_bodies_[m];
    Ball& known = known_[finger][m];
    const Ball needed = neededOn(mesh_body, finger, tick);
    const double held = known.full ? known.radius : 0;
    known = {};
    watch.done(kPlace);
    if (needed.radius < 0) continue;
    const bool fixed = world_->scene.collision.margin > 0;
    const double asked = fixed ? needed.radius : askedFor(needed.radius, held);
    Candidate& candidate = candidates_[candidate_count_];
    candidate.gathered =
        mesh_body.index->gather(mesh_body.X_BG.inverseTimes(needed.center_B), asked, capacity_, candidate.triangles);
    watch.done(kGather);
    if (candidate.triangles.empty()) {
      known = {needed.center_B, asked};
      continue;
    }
    candidate.mesh_body = &mesh_body;
    candidate.needed = needed;
    candidate.nearest = std::ranges::min_element(candidate.triangles, nearer)->distance;
    ++candidate_count_;
  }
}

std::uint64_t CollisionModule::remember(std::size_t finger) noexcept {
  std::uint64_t cut_short = 0;
  for (std::size_t c = 0; c < candidate_count_; ++c) {
    Candidate& candidate = candidates_[c];
    const auto m = static_cast<std::size_t>(candidate.mesh_body - mesh_bodies_.data());
    known_[finger][m] = {candidate.needed.center_B, candidate.gathered.radius, candidate.gathered.capped};
    candidate.gathered.capped = candidate.gathered.radius < candidate.needed.radius;
    cut_short += candidate.gathered.capped;
  }
  return cut_short;
}

std::size_t CollisionModule::keepNearestBodies() noexcept {
  const std::size_t kept = std::min<std::size_t>(candidate_count_, kMaxNearBodies);
  std::partial_sort(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(kept),
                    candidates_.begin() + static_cast<std::ptrdiff_t>(candidate_count_),
                    [](const Candidate& a, const Candidate& b) {
                      return std::pair(a.nearest, a.mesh_body->body) < std::pair(b.nearest, b.mesh_body->body);
                    });
  const std::size_t left_out = candidate_count_ - kept;
  candidate_count_ = kept;
  return left_out;
}

void CollisionModule::keepNearestTriangles() noexcept {
  contenders_.clear();
  for (std::size_t c = 0; c < candidate_count_; ++c) {
    for (const NearTriangle& triangle : candidates_[c].triangles) contenders_.push_back({triangle, c});
  }
  if (contenders_.size() <= capacity_) return;
  // what is needed comes before what would only save the next query
  const auto spare = [&](const Contender& c) { return c.triangle.distance > candidates_[c.candidate].needed.radius; };
  std::ranges::sort(contenders_, [&](const Contender& a, const Contender& b) {
    return std::tuple(spare(a), a.triangle.distance, a.candidate, a.triangle.id) <
           std::tuple(spare(b), b.triangle.distance, b.candidate, b.triangle.id);
  });
  for (std::size_t c = 0; c < candidate_count_; ++c) candidates_[c].triangles.clear();
  for (std::size_t i = 0; i < capacity_; ++i) {
    candidates_[contenders_[i].candidate].triangles.push_back(contenders_[i].triangle);
  }
  for (std::size_t i = capacity_; i < contenders_.size(); ++i) {
    Gathered& gathered = candidates_[contenders_[i].candidate].gathered;
    gathered.capped = true;
    gathered.radius = std::min(gathered.radius, std::nextafter(contenders_[i].triangle.distance, 0.0));
  }
}

void CollisionModule::write(Candidate& candidate, FingerPatch& patch) noexcept {
  const TriMesh& mesh = candidate.mesh_body->index->mesh();
  const std::vector<Vec3>& vertices = candidate.mesh_body->vertices();
  std::ranges::sort(candidate.triangles, {}, &NearTriangle::id);
  BodyPatch& body = patch.bodies[static_cast<std::size_t>(patch.body_count++)];
  body = {candidate.mesh_body->body, patch.triangle_count,      static_cast<std::int32_t>(candidate.triangles.size()),
          candidate.needed.center_B, candidate.gathered.radius, candidate.gathered.capped};
  for (const NearTriangle& near : candidate.triangles) {
    const auto slot = static_cast<std::size_t>(patch.triangle_count++);
    PatchTriangle& out = patch.triangles[slot];
    const auto id = static_cast<std::size_t>(near.id);
    for (std::size_t i = 0; i < 3; ++i) {
      out.v_B[i] = vertices[static_cast<std::size_t>(mesh.triangles[id][i])];
    }
    patch.bounds[slot] = boundOf(out.v_B);
    out.id = near.id;
    out.neighbour = mesh.adjacency[id];
  }
}

std::vector<std::string> CollisionModule::stages() const {
  const char* reach =
      world_->scene.collision.margin > 0 ? "stretch and the scene's margin" : "stretch and motion bound";
  return {
      "pose of each mesh body at this tick, reject bodies whose bounding sphere is out of reach",
      std::string("triangles within fingertip radius, ") + reach + " of each proxy (own traversal of an FCL box tree)",
      "share the patch capacity among the nearest bodies, deliver in body coordinates"};
}

std::vector<std::string> CollisionModule::stageFunctions() const {
  const std::string module = "presa::CollisionModule::", place = module + "neededOn",
                    gather = "presa::TriangleIndex::gather";
  return {place, gather, module + "stepWatched - " + place + " - " + gather};
}

}  // namespace presa
