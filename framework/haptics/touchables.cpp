#include "framework/haptics/touchables.h"

#include <algorithm>
#include <optional>

namespace presa {

std::optional<Primitive> primitiveOf(const Geometry& geometry) {
  Primitive primitive;
  primitive.X_AG = geometry.X_BG;
  if (const auto* box = std::get_if<Box>(&geometry.shape)) {
    primitive.kind = Primitive::Kind::kBox;
    primitive.half = box->size / 2;
  } else if (const auto* sphere = std::get_if<Sphere>(&geometry.shape)) {
    primitive.kind = Primitive::Kind::kSphere;
    primitive.radius = sphere->radius;
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry.shape)) {
    primitive.kind = Primitive::Kind::kCylinder;
    primitive.radius = cylinder->radius;
    primitive.half_length = cylinder->length / 2;
  } else if (const auto* capsule = std::get_if<Capsule>(&geometry.shape)) {
    primitive.kind = Primitive::Kind::kCapsule;
    primitive.radius = capsule->radius;
    primitive.half_length = capsule->length / 2;
  } else {
    return std::nullopt;
  }
  return primitive;
}

namespace {

bool isIdentity(const Pose& X) noexcept { return X.p == Vec3::Zero() && X.q.coeffs() == Quat::Identity().coeffs(); }

}  // namespace

Touchables::Touchable Touchables::touchableOf(const World& world, std::size_t b) {
  const Geometry& geometry = *world.scene.bodies[b].haptic;
  Touchable touchable;
  touchable.body = static_cast<std::int32_t>(b);
  touchable.X_BG = geometry.X_BG;
  if (const std::optional<Primitive> primitive = primitiveOf(geometry)) {
    touchable.primitive = {touchable.body, -1, *primitive};
    touchable.center_B = geometry.X_BG.p;
    touchable.radius = boundingRadius(geometry.shape);
  } else if (const auto& tree = world.meshes[b].haptic_tree) {
    touchable.tree = tree.get();
    touchable.center_B = geometry.X_BG * tree->sphereCenter();
    touchable.radius = tree->sphereRadius();
  } else {
    touchable.body = kNoBody;
  }
  return touchable;
}

Touchables::Touchables(const World& world) {
  const Scene& scene = world.scene;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    X_WB_.push_back(scene.bodies[b].X_WB);
    moves_.push_back(scene.bodies[b].fixed ? 0 : 1);
    touchable_of_.push_back(-1);
    if (!scene.bodies[b].haptic) continue;
    const Touchable touchable = touchableOf(world, b);
    if (touchable.body == kNoBody) continue;
    touchable_of_.back() = static_cast<std::int32_t>(touchables_.size());
    touchables_.push_back(touchable);
    largest_ = std::max(largest_, touchable.radius);
    smallest_ = smallest_ > 0 ? std::min(smallest_, touchable.radius) : touchable.radius;
    mesh_count_ += touchable.tree != nullptr;
  }
  placed_in_.assign(scene.bodies.size(), 0);
}

void Touchables::interpolate(const ObjectState& objects, double time) noexcept {
  objects_ = &objects;
  time_ = time;
  at_end_ = false;
  ++tick_;
}

void Touchables::hold(const ObjectState& objects) noexcept {
  objects_ = &objects;
  at_end_ = true;
  ++tick_;
}

const Pose& Touchables::placed(std::int32_t body) const noexcept {
  const auto b = static_cast<std::size_t>(body);
  if (moves_[b] != 0 && placed_in_[b] != tick_ && body < objects_->count()) {
    placed_in_[b] = tick_;
    X_WB_[b] = at_end_ ? objects_->bodies[b].X_WB_end : objects_->poseAt(body, time_);
  }
  return X_WB_[b];
}

Vec3 Touchables::velocityAt(std::int32_t body, const Vec3& p_W) const noexcept {
  if (objects_ == nullptr || body >= objects_->count()) return Vec3::Zero();
  const BodyMotion& motion = objects_->bodies[static_cast<std::size_t>(body)];
  return motion.v_WB + motion.w_WB.cross(p_W - placed(body).p);
}

double Touchables::surround(Surroundings& near, std::int32_t frame, const Vec3& p_WH, double reach, double moved,
                            double period, const FingerNeighbourhood* neighbourhood) const noexcept {
  near.begin();
  const Pose X_WA = frameOf(frame);
  const Vec3 p_AH = X_WA.inverseTimes(p_WH);
  const Query query{near, frame, X_WA, p_WH, p_AH, reach, moved, period};
  double approach = 0;
  if (neighbourhood != nullptr && (p_WH - neighbourhood->center_W).norm() + reach <= neighbourhood->radius) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(neighbourhood->body_count); ++i) {
      const NearBody& body = neighbourhood->bodies[i];
      const std::int32_t t = touchable_of_[static_cast<std::size_t>(body.body)];
      if (t >= 0) approach = std::max(approach, meet(touchables_[static_cast<std::size_t>(t)], query, &body));
    }
  } else {
    for (const Touchable& touchable : touchables_) approach = std::max(approach, meet(touchable, query, nullptr));
  }
  return approach;
}

double Touchables::meet(const Touchable& touchable, const Query& query, const NearBody* near) const noexcept {
  constexpr double kTicksAhead = 3;  // a moving body is included this many ticks before it can arrive
  const Pose& X_WB = placed(touchable.body);
  double approach = 0;
  if (moves_[static_cast<std::size_t>(touchable.body)] != 0 && objects_ != nullptr &&
      touchable.body < objects_->count()) {
    const BodyMotion& motion = objects_->bodies[static_cast<std::size_t>(touchable.body)];
    const double speed = motion.v_WB.norm() + motion.w_WB.norm() * (query.p_WH - X_WB.p).norm();
    if (speed > 0) approach = query.moved + query.period * speed;
  }
  const double reach = query.reach + kTicksAhead * approach;
  const bool own = touchable.body == query.frame;
  const Vec3 away = own ? Vec3(touchable.center_B - query.p_AH) : Vec3(X_WB * touchable.center_B - query.p_WH);
  if (away.norm() > touchable.radius + reach) return 0;
  if (touchable.tree == nullptr) {
    ConvexPiece piece = touchable.primitive;
    if (!own) std::get_if<Primitive>(&piece.shape)->X_AG = query.X_WA.inverse() * (X_WB * touchable.X_BG);
    query.near.add(piece);
  } else {
    const Pose X_AG = own ? touchable.X_BG : query.X_WA.inverse() * (X_WB * touchable.X_BG);
    const bool same = own && isIdentity(touchable.X_BG);
    query.near.addMesh(touchable.body, *touchable.tree, same ? nullptr : &X_AG, touchable.X_BG, near, query.p_AH,
                       reach);
  }
  return approach;
}

}  // namespace presa
