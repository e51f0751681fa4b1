#include "modules/haptics_proxy/touchables.h"

#include <cmath>

namespace presa {
namespace {

/// A mesh has no exact form here: it comes in patches.
bool makePrimitive(const Geometry& geometry, Primitive& primitive, double& radius) {
  primitive.X_AG = geometry.X_BG;
  if (const auto* box = std::get_if<Box>(&geometry.shape)) {
    primitive.kind = Primitive::Kind::kBox;
    primitive.half = box->size / 2;
    radius = primitive.half.norm();
  } else if (const auto* sphere = std::get_if<Sphere>(&geometry.shape)) {
    primitive.kind = Primitive::Kind::kSphere;
    primitive.radius = radius = sphere->radius;
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry.shape)) {
    primitive.kind = Primitive::Kind::kCylinder;
    primitive.radius = cylinder->radius;
    primitive.half_length = cylinder->length / 2;
    radius = std::hypot(primitive.radius, primitive.half_length);
  } else if (const auto* capsule = std::get_if<Capsule>(&geometry.shape)) {
    primitive.kind = Primitive::Kind::kCapsule;
    primitive.radius = capsule->radius;
    primitive.half_length = capsule->length / 2;
    radius = primitive.radius + primitive.half_length;
  } else {
    return false;
  }
  return true;
}

}  // namespace

Touchables::Touchables(const World& world) {
  const Scene& scene = world.scene;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    X_WB_.push_back(scene.bodies[b].X_WB);
    if (!scene.bodies[b].fixed) moving_.push_back(static_cast<std::int32_t>(b));
    Primitive primitive;
    double radius = 0;
    if (scene.bodies[b].haptic && makePrimitive(*scene.bodies[b].haptic, primitive, radius)) {
      primitives_.push_back({{static_cast<std::int32_t>(b), -1, primitive}, radius});
    }
  }
}

void Touchables::interpolate(const ObjectState& objects, double time) noexcept {
  objects_ = &objects;
  for (const std::int32_t b : moving_) X_WB_[static_cast<std::size_t>(b)] = objects.poseAt(b, time);
}

void Touchables::hold(const ObjectState& objects) noexcept {
  objects_ = &objects;
  for (const auto b : moving_) {
    X_WB_[static_cast<std::size_t>(b)] = objects.bodies[static_cast<std::size_t>(b)].X_WB_end;
  }
}

Vec3 Touchables::velocityAt(std::int32_t body, const Vec3& p_W) const noexcept {
  if (objects_ == nullptr || body >= objects_->count()) return Vec3::Zero();
  const BodyMotion& motion = objects_->bodies[static_cast<std::size_t>(body)];
  return motion.v_WB + motion.w_WB.cross(p_W - X_WB_[static_cast<std::size_t>(body)].p);
}

void Touchables::moveToFrame(Finger& finger, Vec3& point, std::int32_t body) const noexcept {
  if (finger.frame == body) return;
  const Pose X_BA = frameOf(body).inverse() * frameOf(finger.frame);
  finger.tip.x = X_BA * finger.tip.x;
  finger.tip.god = X_BA * finger.tip.god;
  finger.tip.hold = X_BA * finger.tip.hold;
  point = X_BA * point;
  finger.frame = body;
}

void Touchables::surround(const Finger& finger, const Vec3& p_WH, double reach, const FingerPatch* patch,
                          std::uint64_t patch_version) const noexcept {
  Surroundings& near = *finger.near;
  near.begin(finger.frame, patch_version);
  const Pose X_AW = frameOf(finger.frame).inverse();
  for (const PrimitiveBody& body : primitives_) {
    const auto& primitive = *std::get_if<Primitive>(&body.piece.shape);
    const Pose& X_WB = X_WB_[static_cast<std::size_t>(body.piece.body)];
    if ((X_WB * primitive.X_AG.p - p_WH).norm() > body.radius + reach) continue;
    ConvexPiece piece = body.piece;
    if (piece.body != finger.frame) std::get_if<Primitive>(&piece.shape)->X_AG = X_AW * (X_WB * primitive.X_AG);
    near.add(piece);
  }
  if (patch == nullptr) return;
  for (std::size_t i = 0; i < static_cast<std::size_t>(patch->body_count); ++i) {
    const BodyPatch& part = patch->bodies[i];
    const auto first = static_cast<std::size_t>(part.first);
    const PatchTriangle* triangles = &patch->triangles[first];
    const BoundingSphere* bounds = &patch->bounds[first];
    if (part.body == finger.frame) {
      near.addTriangles(triangles, bounds, part.count, part.body, nullptr, {part.center_B, part.radius});
    } else {
      const Pose X_AB = X_AW * frameOf(part.body);
      near.addTriangles(triangles, bounds, part.count, part.body, &X_AB, {X_AB * part.center_B, part.radius});
    }
  }
}

}  // namespace presa
