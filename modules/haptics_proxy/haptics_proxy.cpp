#include "modules/haptics_proxy/haptics_proxy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/plan/plugin.h"

namespace presa {
namespace {

/// A mesh has no exact form here: it comes in patches.
bool makePrimitive(const Geometry& geometry, ConvexPiece& piece, double& radius) {
  piece.X_AG = geometry.X_BG;
  if (const auto* box = std::get_if<Box>(&geometry.shape)) {
    piece.kind = ConvexPiece::Kind::kBox;
    piece.half = box->size / 2;
    radius = piece.half.norm();
  } else if (const auto* sphere = std::get_if<Sphere>(&geometry.shape)) {
    piece.kind = ConvexPiece::Kind::kSphere;
    piece.radius = radius = sphere->radius;
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry.shape)) {
    piece.kind = ConvexPiece::Kind::kCylinder;
    piece.radius = cylinder->radius;
    piece.half_length = cylinder->length / 2;
    radius = std::hypot(piece.radius, piece.half_length);
  } else if (const auto* capsule = std::get_if<Capsule>(&geometry.shape)) {
    piece.kind = ConvexPiece::Kind::kCapsule;
    piece.radius = capsule->radius;
    piece.half_length = capsule->length / 2;
    radius = piece.radius + piece.half_length;
  } else {
    return false;
  }
  return true;
}

}  // namespace

HapticsProxy::HapticsProxy(std::shared_ptr<const World> world)
    : Module("haptics_proxy", RateGroup::kHaptic),
      world_(std::move(world)),
      surroundings_(std::make_unique<Surroundings>()) {
  const Scene& scene = world_->scene;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    X_WB_.push_back(scene.bodies[b].X_WB);
    Primitive primitive;
    primitive.piece.body = static_cast<std::int32_t>(b);
    if (scene.bodies[b].haptic && makePrimitive(*scene.bodies[b].haptic, primitive.piece, primitive.radius)) {
      primitives_.push_back(primitive);
    }
  }
  for (const DeviceRole& role : scene.devices) fingertip_radius_.push_back(role.fingertip_radius);
}

void HapticsProxy::step(const Tick& tick) noexcept {
  placeBodies(tick);
  ContactExchange& out = contact_.value;
  out.time = tick.time;
  out.count = device_->count;
  for (std::size_t f = 0; f < static_cast<std::size_t>(device_->count); ++f) stepFinger(f);
}

// Where every body is now: Object State interpolated to this tick.
void HapticsProxy::placeBodies(const Tick& tick) noexcept {
  if (!objects_.hasValue()) return;
  const auto count = std::min(X_WB_.size(), static_cast<std::size_t>(objects_->count));
  for (std::size_t b = 0; b < count; ++b) {
    if (!world_->scene.bodies[b].fixed) X_WB_[b] = objects_->poseAt(static_cast<std::int32_t>(b), tick.time);
  }
}

Pose HapticsProxy::frameOf(std::int32_t body) const noexcept {
  return body == kNoBody ? Pose{} : X_WB_[static_cast<std::size_t>(body)];
}

void HapticsProxy::moveToFrame(Proxy& proxy, std::int32_t body) const noexcept {
  if (proxy.frame == body) return;
  const Pose X_BA = frameOf(body).inverse() * frameOf(proxy.frame);
  proxy.tip.x = X_BA * proxy.tip.x;
  proxy.tip.god = X_BA * proxy.tip.god;
  proxy.frame = body;
}

// Sets what the fingertip can meet on its way: its centre stays within `reach` of the HIP.
void HapticsProxy::surround(std::size_t finger, const Proxy& proxy, const Vec3& p_WH, double reach) noexcept {
  Surroundings& near = *surroundings_;
  near.clear();
  const Pose X_AW = frameOf(proxy.frame).inverse();
  for (const Primitive& primitive : primitives_) {
    const Pose& X_WB = X_WB_[static_cast<std::size_t>(primitive.piece.body)];
    if ((X_WB * primitive.piece.X_AG.p - p_WH).norm() > primitive.radius + reach) continue;
    ConvexPiece piece = primitive.piece;
    if (piece.body != proxy.frame) piece.X_AG = X_AW * (X_WB * piece.X_AG);
    near.add(piece);
  }
  if (!patches_.hasValue() || finger >= static_cast<std::size_t>(patches_->count)) return;
  const FingerPatch& patch = patches_->fingers[finger];
  for (std::size_t i = 0; i < static_cast<std::size_t>(patch.body_count); ++i) {
    const BodyPatch& part = patch.bodies[i];
    const PatchTriangle* triangles = &patch.triangles[static_cast<std::size_t>(part.first)];
    if (part.body == proxy.frame) {
      near.addTriangles(triangles, part.count, part.body, nullptr, {part.center_B, part.radius});
    } else {
      const Pose X_AB = X_AW * frameOf(part.body);
      near.addTriangles(triangles, part.count, part.body, &X_AB, {X_AB * part.center_B, part.radius});
    }
  }
}

void HapticsProxy::stepFinger(std::size_t f) noexcept {
  const FingerInput& input = device_->fingers[f];
  FingerContact& out = contact_.value.fingers[f];
  Proxy& proxy = proxies_[f];
  out = {};
  out.p_WH = out.p_WP = out.p_BP = input.p_WH;
  out.v_WH = input.v_WH;
  if (!input.valid) return;
  if (!proxy.alive) {
    proxy = {};
    proxy.alive = true;
    proxy.tip.x = proxy.tip.god = input.p_WH;
  }

  const double r = fingertip_radius_[f];
  const Pose X_WA = frameOf(proxy.frame);
  const Vec3 g = X_WA.inverseTimes(input.p_WH);
  surround(f, proxy, input.p_WH,
           std::max((proxy.tip.x - g).norm(), (proxy.tip.god - g).norm()) +
               1.1 * r);  // 10 %: room to be pushed out of a moving body
  const auto cone_of = [this](std::int32_t body) {
    const Material& material = world_->scene.materialOf(world_->scene.bodies[static_cast<std::size_t>(body)]);
    return FrictionCone{material.friction_static, material.friction_dynamic};
  };
  const ProxyContact contact = stepProxy(proxy.tip, g, r, *surroundings_, cone_of);
  countPopThrough(f, contact, r);
  if (!contact.covered) ++contact_.value.coverage_lost;
  proxy.tip = contact.state;
  const std::int32_t next_frame = contact.state.touching ? contact.body : nearestBody(contact.state.x);
  moveToFrame(proxy, next_frame);
  writeContact(out, proxy, contact, X_WA, r);
}

void HapticsProxy::writeContact(FingerContact& out, const Proxy& proxy, const ProxyContact& contact, const Pose& X_WA,
                                double r) const noexcept {
  out.p_WP = X_WA * contact.state.x;
  if (!contact.state.touching) {
    out.p_BP = out.p_WP;
    return;
  }
  const Material& material = world_->scene.materialOf(world_->scene.bodies[static_cast<std::size_t>(contact.body)]);
  out.mode = contact.state.slipping ? ContactMode::kSlip : ContactMode::kStick;
  out.body = contact.body;
  out.nhat_W = X_WA.q * contact.nhat;
  out.nhat_B = frameOf(contact.body).q.conjugate() * out.nhat_W;
  out.p_BP = proxy.tip.x;
  out.p_BC = out.p_BP - r * out.nhat_B;
  out.depth = contact.depth;
  out.stiffness = material.stiffness;
  out.damping = material.damping;
  out.friction_static = material.friction_static;
  out.friction_dynamic = material.friction_dynamic;

  const Vec3 relative = out.v_WH - surfaceVelocity(contact.body, out.p_WP - r * out.nhat_W);
  out.normal_force = std::max(0.0, material.stiffness * contact.depth - material.damping * relative.dot(out.nhat_W));
  // a proxy that waits for its patch would drag: then only the normal part is real
  if (contact.covered) out.tangential_force_W = material.stiffness * (X_WA.q * contact.stretch);
  out.f_H_W = out.normal_force * out.nhat_W + out.tangential_force_W;
}

Vec3 HapticsProxy::surfaceVelocity(std::int32_t body, const Vec3& p_W) const noexcept {
  if (!objects_.hasValue() || body >= objects_->count) return Vec3::Zero();
  const BodyMotion& motion = objects_->bodies[static_cast<std::size_t>(body)];
  return motion.v_WB + motion.w_WB.cross(p_W - X_WB_[static_cast<std::size_t>(body)].p);
}

// The body next to a free fingertip: kept in its coordinates, the proxy sees it come.
std::int32_t HapticsProxy::nearestBody(const Vec3& p) const noexcept {
  std::int32_t body = kNoBody;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < surroundings_->count(); ++i) {
    const ConvexPiece& piece = surroundings_->piece(i);
    if (const double distance = nearest(piece, p).distance; distance < least) {
      least = distance;
      body = piece.body;
    }
  }
  return body;
}

// Checked apart from the algorithm that should prevent it: the fingertip's centre must never come within
// half its radius of a surface.
void HapticsProxy::countPopThrough(std::size_t f, const ProxyContact& contact, double r) noexcept {
  Proxy& proxy = proxies_[f];
  bool overlapping = false;
  for (int i = 0; i < surroundings_->count() && !overlapping; ++i) {
    overlapping = nearest(surroundings_->piece(i), contact.state.x).distance < 0.5 * r;
  }
  if (overlapping && !proxy.overlapping) {
    ++contact_.value.pop_through;
    ++contact_.value.pop_through_by_finger[f];
  }
  proxy.overlapping = overlapping;
}

std::vector<std::string> HapticsProxy::stages() const {
  return {"interpolate the Object State to now", "gather the pieces within reach of each fingertip",
          "move the proxy to the nearest reachable point (active set of at most three)", "friction: two-state cone",
          "force from the distance between proxy and HIP"};
}

namespace {
const ModulePlugin kPlugin{.name = "haptics_proxy",
                           .summary = "god-object with fingertip radius and two-state friction cone, 1 kHz",
                           .create = [](std::shared_ptr<const World> world) -> std::unique_ptr<Module> {
                             return std::make_unique<HapticsProxy>(std::move(world));
                           }};
}  // namespace

}  // namespace presa

PRESA_MODULE_PLUGIN(presa::kPlugin)
