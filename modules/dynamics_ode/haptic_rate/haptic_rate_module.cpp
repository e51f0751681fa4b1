#include "modules/dynamics_ode/haptic_rate/haptic_rate_module.h"

#include <algorithm>

#include "framework/geometry/index.h"
#include "framework/scene/physics_shapes.h"
#include "framework/session/module_plugin.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/finger_impulses.h"
#include "modules/dynamics_ode/haptic_rate/meshes_of_ode.h"

namespace presa::ode {
namespace {

// What a held body will meet is taken over before the dynamics begin the step in which they would let it be hit.
double lookAhead(const Scene& scene) { return 1 / scene.rates.dynamics + 1 / scene.rates.haptic; }

OdeOptions optionsOf(const World& world, std::uint64_t seed) {
  OdeOptions options;
  options.method = world.scene.dynamics;
  options.method.coupling = DynamicsSettings::Coupling::kSoft;
  options.method.sleeping = false;
  options.gives_what_is_felt = true;
  options.look_ahead = lookAhead(world.scene);
  options.seed = seed;
  return options;
}

/// Radius of a sphere about the body's origin that holds its physics geometry [m].
double radiusOf(const Body& body, const BodyMeshes& meshes) {
  Vec3 corner = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0})
      corner[axis] = std::max(corner[axis], supportOf(body, meshes, side * Vec3::Unit(axis)));
  }
  return corner.norm();
}

std::unique_ptr<Module> create(std::shared_ptr<const World> world, const RunOptions& options) {
  if (options.realtime) refuseMeshesOfOde(*world);
  return std::make_unique<HapticRateModule>(std::move(world), options.seed);
}

const ModulePlugin kPlugin{.name = "haptic_rate", .create = create};

}  // namespace

HapticRateModule::HapticRateModule(std::shared_ptr<const World> world, std::uint64_t seed)
    : Module("haptic_rate", RateGroup::kHaptic), world_(std::move(world)), options_(optionsOf(*world_, seed)) {
  const Scene& scene = world_->scene;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    is_free_.push_back(!scene.bodies[i].fixed && world_->inertias[i].mass > 0);
    if (is_free_.back() != 0) free_.push_back(i);
  }
  waits_.resize(scene.bodies.size());
  at_begin_.resize(scene.bodies.size());
  at_end_.resize(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    reaches_.push_back({radiusOf(scene.bodies[i], world_->meshes[i]), scene.bodies[i].X_WB.p});
  }
  // every finger holds a group at most, and as many may be on their way back
  const std::size_t room = std::min(2 * scene.devices.size() * scene.dynamics.max_held, free_.size());
  entries_ = BoundedList<Entry>(room);
  groups_.resize(room);
  out_.value.bodies = BoundedList<HeldBody>(room);
  out_.value.refused = BoundedList<std::int32_t>(std::min(room + scene.devices.size() * kMaxNearBodies, free_.size()));
  FingerImpulses(scene).write(out_.value.counted);
  FingerImpulses(scene).write(shown_objects_.value);
  for (const Body& body : scene.bodies) {
    BodyMotion& motion = shown_objects_.value.bodies.emplace_back();
    motion.X_WB_begin = motion.X_WB_end = body.X_WB;
  }
  if (scene.hasForceEffects()) reactions_.emplace(*this, kEffectReactionsPort, In<EffectReactions>::OfLastTick{});
  if (hasBodyEffects(scene)) body_effects_.emplace(*world_);
  listens_ = needsBodyHits(scene);
  if (listens_) out_.value.hits = BodyHits(BodyHits::roomFor(room));
}

void HapticRateModule::start() {
  attachThread();
  bodies_ = std::make_unique<OdeWorld>(world_, options_);
  if (body_effects_) bodies_->use(*body_effects_);
  if (listens_) bodies_->listen(out_.value.hits.room());
  bodies_->makeRoom(fingers_.sized());
  if (reactions_) bodies_->makeRoom(reactions_->sized());
  for (const std::size_t i : free_) bodies_->hold(i, world_->scene.bodies[i].X_WB, Vec3::Zero(), Vec3::Zero());
  bodies_->writeCounts(out_.value.counted);
}

void HapticRateModule::step(const Tick& tick) noexcept {
  if (!objects_.hasValue()) return;
  now_ = tick.time;
  noteVelocities();
  placeOthers();
  if (reactions_) bodies_->addReactions(reactions_->value(), tick.period);
  bodies_->step(fingers_.value(), tick.time - tick.period, tick.period);
  readBack();
  completeReturns();
  markTouched(fingers_.value());
  findGroups();
  growGroups();
  leaveUntouched();
  write();
}

void HapticRateModule::stop() {
  bodies_.reset();
  detachThread();
}

HapticRateModule::Entry* HapticRateModule::find(std::size_t body) noexcept {
  const auto is = [&](const Entry& entry) { return index(entry.held.body) == body; };
  Entry* const found = std::find_if(entries_.begin(), entries_.end(), is);
  return found == entries_.end() ? nullptr : found;
}

void HapticRateModule::noteVelocities() noexcept {
  if (objects_.version() == noted_) return;
  noted_ = objects_.version();
  std::swap(at_begin_, at_end_);
  for (const std::size_t i : free_) at_end_[i] = {objects_->bodies[i].v_WB, objects_->bodies[i].w_WB};
}

// The body in the dynamics, at the end of its motion where it is felt.
BodyMotion HapticRateModule::inDynamics(std::size_t body) const noexcept {
  BodyMotion motion = objects_->bodies[body];
  if (world_->scene.haptics.pose != HapticSettings::PoseUse::kHold)
    motion.X_WB_end = objects_->poseAt(static_cast<std::int32_t>(body), now_);
  return motion;
}

// The body as the haptic thread shows it now, unless it moves it itself.
BodyMotion HapticRateModule::shown(std::size_t body) noexcept {
  const Entry* entry = find(body);
  return entry == nullptr ? inDynamics(body) : entry->way.at(inDynamics(body), now_);
}

// The body as it is shown now, with its velocity now and not at the end of the dynamics' step: the haptic thread gives
// what is left of that step.
BodyMotion HapticRateModule::shownNow(std::size_t i) noexcept {
  BodyMotion motion = shown(i);
  const double span = objects_->time_end - objects_->time_begin;
  if (world_->scene.haptics.pose == HapticSettings::PoseUse::kHold || !(span > 0)) return motion;
  const double left = std::clamp((objects_->time_end - now_) / span, 0.0, 1.0);
  motion.v_WB -= left * (at_end_[i].v_WB - at_begin_[i].v_WB);
  motion.w_WB -= left * (at_end_[i].w_WB - at_begin_[i].w_WB);
  return motion;
}

// Whether body `i` with its origin at p_W can meet a body that the haptic thread moves.
bool HapticRateModule::isNear(std::size_t i, const Vec3& p_W) const noexcept {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    const double reach = reaches_[i].radius + reaches_[index(entry.held.body)].radius + kMargin;
    return moves(entry) && (entry.held.X_WB.p - p_W).squaredNorm() < reach * reach;
  });
}

Vec3 HapticRateModule::velocityAt(std::size_t body, const Vec3& p_W) noexcept {
  if (is_free_[body] == 0) return Vec3::Zero();
  const Entry* entry = find(body);
  const BodyMotion motion = entry != nullptr && moves(*entry) ? bodies_->motion(body) : shown(body);
  return motion.v_WB + motion.w_WB.cross(p_W - motion.X_WB_end.p);
}

// Whether two bodies touch, or will within the time that contacts are found ahead.
bool HapticRateModule::meet(const BodyContact& contact) noexcept {
  const Vec3 v_AB = velocityAt(index(contact.A), contact.p_W) - velocityAt(index(contact.B), contact.p_W);
  return -contact.depth <= kTouches + options_.look_ahead * std::max(0.0, v_AB.dot(contact.nhat_AB_W));
}

// Obstacles that are far from what the haptic thread moves stay where they are, also when they come from afar.
void HapticRateModule::placeOthers() noexcept {
  for (const std::size_t i : free_) {
    Reach& reach = reaches_[i];
    if (!isNear(i, objects_->bodies[i].X_WB_end.p) && !isNear(i, reach.placed)) continue;
    if (const Entry* entry = find(i); entry != nullptr && moves(*entry)) continue;
    const BodyMotion motion = shown(i);
    reach.placed = motion.X_WB_end.p;
    bodies_->hold(i, motion.X_WB_end, motion.v_WB, motion.w_WB);
  }
}

void HapticRateModule::readBack() noexcept {
  for (Entry& entry : entries_) {
    if (!moves(entry)) continue;
    const BodyMotion motion = bodies_->motion(index(entry.held.body));
    entry.held.X_WB = motion.X_WB_end;
    entry.held.v_WB = motion.v_WB;
    entry.held.w_WB = motion.w_WB;
  }
}

// Hands bodies over to the dynamics that have taken them, and forgets those that have arrived.
void HapticRateModule::completeReturns() noexcept {
  for (std::size_t e = entries_.size(); e-- > 0;) {
    Entry& entry = entries_[e];
    HeldBody& held = entry.held;
    const std::size_t body = index(held.body);
    if (held.phase == HeldBody::Phase::kLeaving && objects_->held_time >= entry.leaving_since) {
      entry.way = GentleReturn(bodies_->motion(body), inDynamics(body), now_);
      held.phase = HeldBody::Phase::kGivenBack;
      bodies_->hold(body, held.X_WB, held.v_WB, held.w_WB);
    }
    if (held.phase != HeldBody::Phase::kGivenBack) continue;
    const BodyMotion motion = entry.way.at(inDynamics(body), now_);
    held.X_WB = motion.X_WB_end;
    held.v_WB = motion.v_WB;
    held.w_WB = motion.w_WB;
    if (!entry.way.isOver(now_)) continue;
    entries_.remove(e);
    copied_ = 0;
  }
}

void HapticRateModule::markTouched(const ContactExchange& fingers) noexcept {
  for (Entry& entry : entries_) entry.finger = false;
  for (const FingerContact& finger : fingers.fingers) {
    if (finger.mode == ContactMode::kNone) continue;
    if (finger.contact_count < 2) {
      touch(finger.body);
    } else {
      for (const ToolContact& contact : fingers.contactsOf(finger)) touch(contact.body);
    }
  }
}

void HapticRateModule::touch(std::int32_t body) noexcept {
  const std::size_t i = index(body);
  if (body < 0 || i >= is_free_.size() || is_free_[i] == 0) return;
  Entry* entry = find(i);
  if ((entry == nullptr || !isHeld(*entry)) && now_ >= waits_[i].until) {
    if (takeIsland(i, {0, now_}) > 0) {
      entry = find(i);
    } else {
      ++out_.value.too_many;
      wait(i);
    }
  }
  if (entry != nullptr) entry->finger = true;
}

// Takes over body `i` with all that it is in contact with. Returns the number of bodies; 0: they are too many.
std::size_t HapticRateModule::takeIsland(std::size_t i, const Joined& to) noexcept {
  std::size_t count = 0, added = 0;
  const auto comes = [&](std::size_t j, const Entry* entry) {
    if (j != i && objects_->bodies[j].island != objects_->bodies[i].island) return false;
    return entry == nullptr || !isHeld(*entry);
  };
  for (const std::size_t j : free_) {
    const Entry* entry = find(j);
    if (!comes(j, entry)) continue;
    ++count;
    added += entry == nullptr ? 1 : 0;
  }
  if (to.size + count > world_->scene.dynamics.max_held || entries_.size() + added > entries_.capacity()) return 0;
  for (const std::size_t j : free_) {
    if (comes(j, find(j))) take(j, to);
  }
  return count;
}

// Takes body `i` over as it is shown.
void HapticRateModule::take(std::size_t i, const Joined& to) noexcept {
  Entry* entry = find(i);
  const bool leaving = entry != nullptr && entry->held.phase == HeldBody::Phase::kLeaving;
  const BodyMotion motion = leaving ? bodies_->motion(i) : shownNow(i);
  if (entry == nullptr) entry = entries_.add();
  if (entry == nullptr) return;  // takeIsland made sure of the room
  *entry = {};
  entry->held = {static_cast<std::int32_t>(i), HeldBody::Phase::kHeld, now_, motion.X_WB_end, motion.v_WB, motion.w_WB};
  entry->touched = to.touched;
  entry->group = to.group;
  if (!leaving) bodies_->release(i, motion.X_WB_end, motion.v_WB, motion.w_WB);
  ++out_.value.taken;
}

bool HapticRateModule::unite(Entry& a, Entry& b) noexcept {
  if (a.group == b.group) return false;
  a.group = b.group = std::min(a.group, b.group);
  return true;
}

// Groups of held bodies in contact or joined, by their least entry.
void HapticRateModule::findGroups() noexcept {
  for (std::size_t e = 0; e < entries_.size(); ++e) entries_[e].group = e;
  for (bool changed = true; changed;) {
    changed = false;
    for (const BodyContact& contact : bodies_->contacts()) {
      Entry *a = find(index(contact.A)), *b = find(index(contact.B));
      if (a == nullptr || b == nullptr || !isHeld(*a) || !isHeld(*b) || !meet(contact)) continue;
      changed = unite(*a, *b) || changed;
    }
    for (const Joint& joint : world_->scene.joints) {
      Entry *a = find(joint.body), *b = joint.to == Joint::kWorld ? nullptr : find(joint.to);
      if (a != nullptr && b != nullptr && isHeld(*a) && isHeld(*b)) changed = unite(*a, *b) || changed;
    }
  }
  std::fill(groups_.begin(), groups_.end(), Group{});
  for (const Entry& entry : entries_) {
    if (!isHeld(entry)) continue;
    Group& group = groups_[entry.group];
    ++group.size;
    group.touched = group.touched || entry.finger;
  }
}

// A joined pair is held or free as one, also where its islands were not found together: on its way back, touched again.
void HapticRateModule::takeJoined() noexcept {
  for (bool grown = true; grown;) {
    grown = false;
    for (const Joint& joint : world_->scene.joints) {
      if (joint.to == Joint::kWorld) continue;
      grown = takePartner(joint.body, joint.to) || takePartner(joint.to, joint.body) || grown;
    }
  }
}

bool HapticRateModule::takePartner(std::size_t one, std::size_t other) noexcept {
  const Entry* holder = find(one);
  if (holder == nullptr || !isHeld(*holder) || is_free_[other] == 0) return false;
  Group& group = groups_[holder->group];
  if (const Entry* partner = find(other); !group.grows || (partner != nullptr && isHeld(*partner))) return false;
  const std::size_t taken = takeIsland(other, {group.size, holder->touched, holder->group});
  group.grows = taken > 0;
  group.size += taken;
  return taken > 0;
}

// Takes over what a held group has met, also on its way after the fingers let go.
void HapticRateModule::growGroups() noexcept {
  for (const BodyContact& contact : bodies_->contacts()) {
    for (const auto& [one, other] : {std::pair(contact.A, contact.B), std::pair(contact.B, contact.A)}) {
      const Entry* holder = find(index(one));
      if (holder == nullptr || !isHeld(*holder) || is_free_[index(other)] == 0) continue;
      Group& group = groups_[holder->group];
      if (const Entry* met = find(index(other)); !group.grows || (met != nullptr && moves(*met)) || !meet(contact))
        continue;
      const std::size_t taken = takeIsland(index(other), {group.size, holder->touched, holder->group});
      group.grows = taken > 0;
      group.size += taken;
    }
  }
  takeJoined();
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (groups_[g].size > world_->scene.dynamics.max_held || !groups_[g].grows) giveBack(g);
  }
}

void HapticRateModule::leave(Entry& entry) noexcept {
  entry.held.phase = HeldBody::Phase::kLeaving;
  entry.leaving_since = now_;
}

// A group that is too large goes back as a whole, and is tried again later.
void HapticRateModule::giveBack(std::size_t group) noexcept {
  ++out_.value.too_many;
  for (Entry& entry : entries_) {
    if (!isHeld(entry) || entry.group != group) continue;
    leave(entry);
    wait(index(entry.held.body));
  }
}

// Leaves body `i` to the dynamics for a while, twice as long each time.
void HapticRateModule::wait(std::size_t i) noexcept {
  Wait& wait = waits_[i];
  wait = {now_ + wait.next, std::min(2 * wait.next, kLastWait)};
  BoundedList<std::int32_t>& refused = out_.value.refused;
  const auto body = static_cast<std::int32_t>(i);
  if (std::ranges::find(refused, body) != refused.end() || refused.add(body) != nullptr) return;
  const auto until = [&](std::int32_t other) { return waits_[index(other)].until; };
  *std::ranges::min_element(refused, {}, until) = body;  // no room: that which would end first ends now
}

void HapticRateModule::endWaits() noexcept {
  BoundedList<std::int32_t>& refused = out_.value.refused;
  for (std::size_t r = refused.size(); r-- > 0;) {
    if (now_ >= waits_[index(refused[r])].until) refused.remove(r);
  }
}

void HapticRateModule::leaveUntouched() noexcept {
  for (Entry& entry : entries_) {
    if (!isHeld(entry)) continue;
    if (groups_[entry.group].touched) {
      entry.touched = now_;
    } else if (now_ - entry.touched > kLetGo) {
      leave(entry);
      waits_[index(entry.held.body)] = {};
    }
  }
}

void HapticRateModule::write() noexcept {
  HeldBodies& out = out_.value;
  out.time = now_;
  out.bodies.clear();
  for (const Entry& entry : entries_) out.bodies.add(entry.held);
  endWaits();
  bodies_->writeCounts(out.counted);
  if (listens_) out.hits = bodies_->hits();
  show();
}

// The dynamics' newest state, in which the held bodies are where they are now at both ends.
void HapticRateModule::show() noexcept {
  ObjectState& shown = shown_objects_.value;
  if (objects_.version() != copied_) shown = objects_.value();
  copied_ = objects_.version();
  for (const HeldBody& held : out_.value.bodies) {
    BodyMotion& motion = shown.bodies[index(held.body)];
    motion.X_WB_begin = motion.X_WB_end = held.X_WB;
    motion.v_WB = held.v_WB;
    motion.w_WB = held.w_WB;
    motion.asleep = false;
  }
}

std::vector<std::string> HapticRateModule::stages() const {
  std::vector<std::string> stages;
  if (body_effects_) {
    for (const std::string& name : body_effects_->names()) stages.push_back("body effect " + name);
  }
  stages.push_back("move what fingers touched in the last tick, with what it touches, up to " +
                   std::to_string(world_->scene.dynamics.max_held) + " bodies in contact");
  stages.emplace_back("take bodies over from the dynamics, and give them back without a step in pose or velocity");
  return stages;
}

std::optional<std::string> HapticRateModule::brokenPlugin() const {
  return body_effects_ ? body_effects_->brokenName() : std::nullopt;
}

}  // namespace presa::ode

PRESA_MODULE_PLUGIN(presa::ode::kPlugin)
