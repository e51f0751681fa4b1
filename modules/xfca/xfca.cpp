// Extended friction cone algorithm [Harwin & Barrow 2013, 4.1]: the tool follows the handle in orientation and is held off
// the bodies in translation. Method: modules/xfca/README.md.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/virtual_coupling.h"
#include "modules/xfca/friction_circle.h"
#include "modules/xfca/god_object.h"
#include "modules/xfca/pair_objects.h"
#include "modules/xfca/places.h"

namespace presa {
namespace {

// range of the planes of a tick: of the way from god-object to handle, and where that is short [m]
constexpr double kRange = 3, kRangeAtRest = 1e-4;

/// One tool of the scene.
struct Held {
  Held(const ConvexSolid& solid, const std::vector<ConvexSolid>& bodies) : pairs(solid, bodies) {}

  ConvexPairs pairs;
  GodObject god_object{pairs};
  std::unique_ptr<Places> places;
  std::unique_ptr<PairObjects> printed;  // null: one god-object for all pairs
  ToolCoupling coupling;
  std::int32_t frame = kNoBody;  // body that it touches, in whose coordinates it stays
  Vec3 p_A = Vec3::Zero();
  bool touching = false, slipping = false;
};

class Xfca final : public ToolRenderer {
 public:
  Xfca(const PluginElement& settings, const World& world);
  void touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept override;
  std::size_t maxForces() const noexcept override { return Places::kMax; }
  std::string what() const override;

 private:
  /// One tool against the bodies in one tick.
  struct Contact {
    GodObject::Push push;
    Vec3 lag = Vec3::Zero();  // of the god-object behind where it would be without friction [m]
    FrictionCoefficients friction{0, 0};
    bool arrived = true, whole = true;
  };
  void readFriction(const ToolInput& input) noexcept;
  /// Moves the god-object.
  Contact settle(const ToolInput& input, Held& held, Vec3& god) const noexcept;
  void write(const Contact& contact, const Vec3& p_WH, Held& held, BoundedList<ToolForce>& forces,
             ToolState& state) const noexcept;
  void touchAsPrinted(const ToolInput& input, Held& held, BoundedList<ToolForce>& forces, ToolState& state) noexcept;
  /// Of the places, weighted by their depths.
  FrictionCoefficients frictionAt(const BoundedList<Place>& places) const noexcept;
  /// Part of the way beyond the circle of friction that a tool slips in a tick.
  double fraction(const ToolCoupling& coupling, double period) const noexcept {
    return 1 / (1 + viscosity_ / (coupling.stiffness * period));
  }

  const Scene& scene_;
  double viscosity_;  // [N s/m]
  bool printed_;
  std::vector<ConvexSolid> bodies_, tools_;
  std::vector<FrictionCoefficients> friction_;     // by body of bodies_
  std::vector<FrictionCoefficients> friction_of_;  // by body of the scene
  std::vector<std::unique_ptr<Held>> held_;        // by device role; null: a fingertip
};

Xfca::Xfca(const PluginElement& settings, const World& world)
    : scene_(world.scene),
      viscosity_(settings.number("viscosity")),
      printed_(settings.boolean("printed")),
      bodies_(convexBodies(world, partSettings(settings))),
      friction_(bodies_.size()),
      friction_of_(world.scene.bodies.size()),
      held_(world.scene.devices.size()) {
  tools_.resize(held_.size());
  for (std::size_t d = 0; d < held_.size(); ++d) {
    if (!world.tools[d]) continue;
    tools_[d] = convexTool(world, d, partSettings(settings));
    held_[d] = std::make_unique<Held>(tools_[d], bodies_);
    Held& held = *held_[d];
    held.coupling = scene_.devices[d].tool->coupling;
    held.places = std::make_unique<Places>(held.pairs, bodies_);
    if (!printed_) continue;
    const PairObjects::Law law{held.coupling, settings.number("curvature"),
                               fraction(held.coupling, 1 / scene_.rates.haptic)};
    held.printed = std::make_unique<PairObjects>(held.pairs, bodies_, friction_, law);
  }
}

void Xfca::readFriction(const ToolInput& input) noexcept {
  for (std::size_t s = 0; s < bodies_.size(); ++s) {
    const auto body = static_cast<std::size_t>(bodies_[s].body);
    const Material& material = input.materials[scene_.bodies[body].material];
    friction_[s] = friction_of_[body] = {material.friction_static, material.friction_dynamic};
  }
}

FrictionCoefficients Xfca::frictionAt(const BoundedList<Place>& places) const noexcept {
  FrictionCoefficients mean{0, 0};
  double sum = 0;
  for (const Place& place : places) {
    const FrictionCoefficients& own = friction_of_[static_cast<std::size_t>(place.body)];
    mean.mu_static += place.depth * own.mu_static;
    mean.mu_dynamic += place.depth * own.mu_dynamic;
    sum += place.depth;
  }
  if (sum > 0) mean = {mean.mu_static / sum, mean.mu_dynamic / sum};
  return mean;
}

void Xfca::touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept {
  Held& held = *held_[input.tool];
  readFriction(input);
  held.pairs.place(input.touchables);
  if (!state.alive) {
    held.pairs.forget();
    held.touching = false;
    if (held.printed) held.printed->letGo();
  }
  state.points = 0;
  if (held.printed) return touchAsPrinted(input, held, forces, state);

  const Vec3& handle = input.X_WH.p;
  Vec3 god = state.alive ? input.touchables.frameOf(held.frame) * held.p_A : handle;
  held.frame = kNoBody;
  const Contact contact = settle(input, held, god);
  state.coarse += contact.whole && held.god_object.complete() ? 0 : 1;
  state.late += contact.arrived ? 0 : 1;
  state.X_WT = {god, input.X_WH.q};
  if (held.touching) write(contact, handle, held, forces, state);
  held.p_A = input.touchables.frameOf(held.frame).inverseTimes(god);
}

Xfca::Contact Xfca::settle(const ToolInput& input, Held& held, Vec3& god) const noexcept {
  const Quat& q = input.X_WH.q;
  const Vec3& handle = input.X_WH.p;
  Contact contact;
  held.god_object.begin();
  // all planes once, as far as any of the motions below can want them
  const auto look = [&] {
    const double range = kRange * (handle - god).norm() + kRangeAtRest;
    contact.whole = held.pairs.gather({god, q}, range) && contact.whole;
    held.pairs.separate({god, q}, range);
  };
  look();
  // turned with the handle, and where bodies move against each other, it may have to give way first
  const Vec3 start = god;
  contact.arrived = held.god_object.slide(q, start, god);
  if ((god - start).norm() > kRangeAtRest / 2) look();
  Vec3 surface = god;
  contact.arrived = held.god_object.slide(q, handle, surface) && contact.arrived;
  contact.push = held.god_object.pushOn(handle, surface);
  held.places->find(contact.push);
  const bool touched_before = held.touching;
  held.touching = !held.places->all().empty() && contact.push.shift.norm() > 0;
  if (!held.touching || !touched_before) {
    god = surface;
    held.slipping = false;
    return contact;
  }
  contact.friction = frictionAt(held.places->all());
  // friction holds it along the surface: where the surface has fallen away below it, it follows
  const double depth = contact.push.shift.norm(), above = (god - surface).dot(contact.push.shift) / depth;
  const bool is_above = above > GodObject::kSkin;
  const Vec3 along = is_above ? Vec3(god - above / depth * contact.push.shift) : god;
  const Vec3 held_at =
      heldByFriction(surface, along, depth, contact.friction, fraction(held.coupling, input.period), held.slipping);
  if (held.slipping || is_above) {
    god = surface;
    contact.arrived = held.god_object.slide(q, handle + held_at - surface, god) && contact.arrived;
  }
  contact.lag = god - surface;
  return contact;
}

void Xfca::write(const Contact& contact, const Vec3& p_WH, Held& held, BoundedList<ToolForce>& forces,
                 ToolState& state) const noexcept {
  const BoundedList<Place>& places = held.places->all();
  const Vec3 shift = contact.push.shift + contact.lag;
  const ToolCoupling& coupling = held.coupling;
  const double length = shift.norm();
  if (!(length > 0)) return;
  double sum = 0;
  Vec3 torque = Vec3::Zero();  // about the handle, without a limit
  for (const Place& place : places) sum += place.depth;
  for (const Place& place : places) {
    const Vec3 force = coupling.stiffness * (place.depth * place.nhat_W + place.depth / sum * contact.lag);
    torque += (place.p_W + contact.lag - p_WH).cross(force);
  }
  double scale = saturated(coupling.stiffness * shift, coupling.max_force).norm() / length;
  if (torque.norm() > 0)
    scale = std::min(scale, coupling.stiffness * saturated(torque, coupling.max_torque).norm() / torque.norm());
  const Place* deepest = places.begin();
  for (const Place& place : places) {
    const double share = place.depth / sum;
    forces.add({.body = place.body,
                .p_W = place.p_W + contact.lag,
                .nhat_W = place.nhat_W,
                .f_W = scale * (place.depth * place.nhat_W + share * contact.lag),
                .stiffness = coupling.stiffness * share,
                .friction_static = contact.friction.mu_static,
                .friction_dynamic = contact.friction.mu_dynamic,
                .slips = held.slipping});
    if (place.depth > deepest->depth) deepest = &place;
  }
  held.frame = deepest->body;
  state.points = static_cast<std::uint32_t>(places.size());
}

void Xfca::touchAsPrinted(const ToolInput& input, Held& held, BoundedList<ToolForce>& forces,
                          ToolState& state) noexcept {
  state.coarse += held.printed->touch(input.X_WH, input.touchables, forces) ? 0 : 1;
  state.X_WT = input.X_WH;
  for (const ToolForce& one : forces) state.X_WT.p += one.f_W / held.coupling.stiffness;
  state.points = static_cast<std::uint32_t>(forces.size());
}

std::string Xfca::what() const {
  std::string text = "hold tools off the bodies in translation, in convex parts: ";
  text += textOf(bodies_) + "; tools of ";
  std::size_t parts = 0;
  for (const ConvexSolid& tool : tools_) parts += tool.parts.size();
  text += std::to_string(parts) + " parts";
  return printed_ ? text + "; a god-object for each pair, as printed" : text;
}

const ToolRendererPlugin kPlugin{
    .name = "xfca", .create = [](const PluginElement& settings, const World& world) -> std::unique_ptr<ToolRenderer> {
      return std::make_unique<Xfca>(settings, world);
    }};

}  // namespace
}  // namespace presa

PRESA_TOOL_RENDERER_PLUGIN(presa::kPlugin)
