#include "modules/haptics_proxy/haptics_proxy.h"

#include <algorithm>
#include <limits>

#include "framework/haptics/renderers.h"
#include "framework/session/module_plugin.h"
#include "modules/haptics_proxy/contact_set.h"

namespace presa {
namespace {

void interpolateBodies(Touchables& touchables, const ObjectState& objects, double time) noexcept {
  touchables.interpolate(objects, time);
}
void holdBodies(Touchables& touchables, const ObjectState& objects, double) noexcept { touchables.hold(objects); }

}  // namespace

HapticsProxy::HapticsProxy(std::shared_ptr<const World> world, const HapticEffects& effects)
    : Module("haptics_proxy", RateGroup::kHaptic),
      world_(std::move(world)),
      effects_(effects),
      touchables_(*world_),
      objects_(*this, effects.held ? kShownObjectsPort : "object_state", In<ObjectState>::Optional{}, WhenOld::kHold) {
  if (effects.poses == HapticEffects::Poses::kInterpolate) {
    place_bodies_.push_back({"interpolate the Object State to now", interpolateBodies});
  } else if (effects.poses == HapticEffects::Poses::kHold) {
    place_bodies_.push_back({"use the body poses at the end of the last dynamics step", holdBodies});
  }
  const SurfacesInForce in_force = surfaces(effects);
  if (world_->scene.hasFingertips()) addFingertips(effects, in_force);
  std::size_t contacts = std::max(ActiveSet{}.member.size(), own_contacts_.capacity());
  if (world_->scene.hasTools()) {
    tools_.push_back(std::make_unique<HeldTools>(*this, *world_, in_force.materials));
    contacts = std::max(contacts, tools_.front()->maxForces());
  }
  contact_.value = ContactExchange(world_->scene.devices.size(), contacts);
}

void HapticsProxy::addFingertips(const HapticEffects& effects, const SurfacesInForce& in_force) {
  for (const DeviceRole& role : world_->scene.devices) {
    RenderedFinger finger;
    finger.radius = std::max(role.fingertip_radius, touchables_.lift());
    finger.lift = finger.radius - role.fingertip_radius;
    if (!role.tool) {
      finger.near = std::make_unique<Surroundings>(touchables_.meshCount());
      fingertips_.push_back(fingers_.size());
    }
    fingers_.push_back(std::move(finger));
  }
  renderer_ = makeRenderer(*world_);
  own_contacts_ = BoundedList<RenderedContact>(renderer_->maxOwnContacts());
  std::unique_ptr<SurfaceStage> surfaces;
  if (effects.surface_effects) {
    if (effects.hits) hits_.emplace(*this, kBodyHitsPort, In<BodyHits>::Optional{});
    surfaces = makeSurfaces(*world_, in_force, hits_ ? &*hits_ : nullptr);
    surface_effects_ = surfaces.get();
  }
  if (effects.friction) {
    auto friction = frictionOf(effects, in_force);
    friction_ = friction.get();
    finger_stages_.push_back(std::move(friction));
  }
  if (surfaces) finger_stages_.push_back(std::move(surfaces));
  finger_stages_.push_back(effects.surface_effects ? makeSoftSpring(in_force) : makeSpring(in_force));
  if (effects.damping) finger_stages_.push_back(makeDamping(in_force));
  if (effects.torsion) finger_stages_.push_back(makeTorsion(in_force));
  if (effects.impulse) finger_stages_.push_back(makeImpulse(fingers_.size()));
  if (world_->scene.hasForceEffects()) force_effects_.push_back(std::make_unique<Effects>(*this, *world_));
}

SurfacesInForce HapticsProxy::surfaces(const HapticEffects& effects) {
  if (!effects.commanded) return {world_->scene, world_->scene.materials};
  commanded_.push_back(std::make_unique<Commanded>(*this, world_->scene));
  return {world_->scene, commanded_.back()->surfaces.materials()};
}

std::unique_ptr<FrictionStage> HapticsProxy::frictionOf(const HapticEffects& effects, const SurfacesInForce& surfaces) {
  SurfaceStage* const places =
      surface_effects_ != nullptr && surface_effects_->changesFriction() ? surface_effects_ : nullptr;
  if (!effects.surface_change) return makeFriction(surfaces, *renderer_, places);
  return makeChangingFriction(surfaces, *renderer_, places,
                              surface_change_.emplace(*this, "surface_change", In<SurfaceChange>::Optional{}));
}

void HapticsProxy::step(const Tick& tick) noexcept {
  for (const auto& commanded : commanded_) commanded->surfaces.step(commanded->settings.value(), tick.period);
  if (objects_.hasValue()) {
    for (const PlaceBodies& stage : place_bodies_) stage.apply(touchables_, objects_.value(), tick.time);
  }
  ContactExchange& out = contact_.value;
  out.time = tick.time;
  out.contacts.clear();
  for (const std::size_t f : fingertips_) stepFinger(f, tick);
  for (const auto& tools : tools_) tools->step(device_.value(), tick.period, touchables_, out);
}

void HapticsProxy::stepFinger(std::size_t f, const Tick& now) noexcept {
  const FingerInput& input = device_->fingers[f];
  FingerContact& out = contact_.value.fingers[f];
  RenderedFinger& finger = fingers_[f];
  out = {};
  out.p_WH = out.p_WP = out.p_BP = input.p_WH;
  out.v_WH = input.v_WH;
  if (!input.valid) return;
  if (!finger.alive) {
    finger.alive = true;
    finger.tip.x = finger.tip.god_object = finger.p_WH = input.p_WH;
  }

  const Pose X_WA = touchables_.frameOf(finger.frame);
  const Vec3 g = X_WA.inverseTimes(input.p_WH);
  const double approach = gather(f, g, now.period);
  own_contacts_.clear();
  FingerTick tick{.index = f,
                  .input = input,
                  .finger = finger,
                  .out = out,
                  .all = contact_.value,
                  .touchables = touchables_,
                  .time = now.time,
                  .period = now.period,
                  .r = finger.radius,
                  .approach = approach,
                  .X_WA = X_WA,
                  .g = g,
                  .contact = renderer_->touch({f, g, finger.radius, finger.tip, X_WA, *finger.near, own_contacts_}),
                  .own_contacts = own_contacts_};
  checkContract(tick);
  for (const auto& stage : finger_stages_) stage->apply(tick);
  if (tick.next_frame != finger.frame) changeFrame(tick);
  out.f_H_W = out.normal_force * out.nhat_W + out.tangential_force_W;
  finishContacts(tick);
  if (tick.broken) out.f_H_W.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (const auto& added : force_effects_)
    added->effects.apply(f, now, input, world_->scene.devices[f].fingertip_radius, touchables_, out,
                         added->reactions.value);
}

// What the fingertip can reach in this tick. Returns how far a surface may have approached it.
double HapticsProxy::gather(std::size_t f, const Vec3& g, double period) noexcept {
  RenderedFinger& finger = fingers_[f];
  const Vec3& p_WH = device_->fingers[f].p_WH;
  const double way = std::max((finger.tip.x - g).norm(), (finger.tip.god_object - g).norm());
  const double moved = (p_WH - finger.p_WH).norm();
  finger.p_WH = p_WH;
  const bool patched = neighbourhoods_.hasValue() && f < static_cast<std::size_t>(neighbourhoods_->count);
  // 10 %: room for being pushed out of a moving body
  const double approach = touchables_.surround(*finger.near, finger.frame, p_WH, way + 1.1 * finger.radius, moved,
                                               period, patched ? &neighbourhoods_->fingers[f] : nullptr);
  finger.near->setStep(moved + approach);
  return approach;
}

// A contact that a renderer must not give ends the run.
void HapticsProxy::checkContract(FingerTick& tick) noexcept {
  if (own_contacts_.lost() > 0) ++contact_.value.coverage_lost;
  if (keepsContract(tick.contact, own_contacts_, touchables_)) [[likely]]
    return;
  renderer_broken_.store(true, std::memory_order_release);
  tick.broken = true;
  own_contacts_.clear();
  tick.contact = {};
  tick.contact.x = tick.contact.state.x = tick.contact.state.god_object = tick.g;
}

// Moves the finger's state into the coordinates of the next frame.
void HapticsProxy::changeFrame(FingerTick& tick) noexcept {
  ProxyState& tip = tick.finger.tip;
  tip.x = tick.X_BA * tip.x;
  tip.god_object = tick.X_BA * tip.god_object;
  renderer_->changeFrame(tick.index, tick.X_BA);
  for (const auto& stage : finger_stages_) stage->changeFrame(tick.index, tick.X_BA);
  tick.finger.frame = tick.next_frame;
}

std::optional<std::string> HapticsProxy::brokenPlugin() const {
  if (renderer_broken_.load(std::memory_order_acquire)) return "renderer '" + world_->scene.haptics.renderer + "'";
  for (const auto& tools : tools_) {
    if (tools->broken()) return "tool renderer '" + world_->scene.haptics.tool_renderer + "'";
  }
  for (const auto& added : force_effects_) {
    const int broken = added->effects.broken();
    if (broken >= 0) return "force effect " + added->effects.names()[static_cast<std::size_t>(broken)];
  }
  if (surface_effects_ != nullptr && !surface_effects_->broken().empty()) return surface_effects_->broken();
  return friction_ == nullptr ? std::nullopt : friction_->brokenLaw();
}

std::vector<std::string> HapticsProxy::stages() const {
  std::vector<std::string> stages;
  if (!commanded_.empty()) stages.emplace_back("move the surface parameters smoothly to their commanded values");
  for (const PlaceBodies& stage : place_bodies_) stages.emplace_back(stage.what);
  if (renderer_) {
    stages.emplace_back("gather the pieces within reach of each fingertip");
    stages.push_back(renderer_->what());
  }
  for (const auto& tools : tools_) stages.push_back(tools->what());
  for (const auto& stage : finger_stages_) stages.emplace_back(stage->what());
  for (const auto& added : force_effects_) {
    for (const std::string& name : added->effects.names()) stages.push_back("force effect " + name);
  }
  return stages;
}

namespace {
const ModulePlugin kPlugin{
    .name = "haptics_proxy",
    .create = [](std::shared_ptr<const World> world, const RunOptions& options) -> std::unique_ptr<Module> {
      return std::make_unique<HapticsProxy>(world, options);
    }};
}  // namespace

}  // namespace presa

PRESA_MODULE_PLUGIN(presa::kPlugin)
