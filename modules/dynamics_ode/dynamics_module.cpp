#include "modules/dynamics_ode/dynamics_module.h"

#include <algorithm>
#include <iterator>

#include "framework/geometry/index.h"
#include "framework/scene/ages.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/finger_impulses.h"

namespace presa::ode {
namespace {

static_assert(std::uint32_t{Faults::kBodyFrozen} == kFaultBodyFrozen &&
              std::uint32_t{Faults::kEngineFailed} == kFaultEngineFailed &&
              std::uint32_t{Faults::kBadFinger} == kFaultBadFinger &&
              std::uint32_t{Faults::kBadEffect} == kFaultBadEffect);

OdeOptions optionsOf(const World& world, std::uint64_t seed) {
  OdeOptions options;
  options.method = world.scene.dynamics;
  using Coupling = DynamicsSettings::Coupling;
  if (options.method.coupling == Coupling::kHapticRate) options.method.coupling = Coupling::kSoft;
  options.seed = seed;
  return options;
}

/// The stages of a dynamics step that a scene uses, in order.
std::vector<std::string> listStages(const OdeOptions& options) {
  using D = DynamicsSettings;
  const D& method = options.method;
  const std::string iterations =
      method.iterations > 0 ? std::to_string(method.iterations) : "up to " + std::to_string(options.max_iterations);
  std::vector<std::string> all;
  if (method.sleeping) all.emplace_back("wake bodies that a finger or a moving body touches; bodies at rest sleep");
  all.emplace_back(
      "collide the physics geometries, a step ahead of the contact (sort and sweep, at most 8 contacts per pair)");
  all.emplace_back(
      "extrapolate each finger with its velocity and acceleration; a finger without a sample for 20 ms fades");
  all.emplace_back(method.coupling == D::Coupling::kSoft
                       ? "fingers as implicit spring-dampers (soft contact joints) inside their friction cone"
                   : method.coupling == D::Coupling::kExplicit
                       ? "fingers as forces that act for one step"
                       : "fingers as the mean of the forces that they felt since the last step");
  if (usesOwnSolvers(method)) {
    const std::string small_steps =
        std::to_string(options.small_steps.count) + " small steps of projected Gauss-Seidel, warm-started";
    all.push_back(method.solver == D::Solver::kSmallSteps
                      ? "solve all islands in " + small_steps
                      : "solve each island as a convex minimisation by Newton's method with a sparse factorisation");
    if (method.solver == D::Solver::kAuto) all.push_back("solve heaps that fill the factorisation in " + small_steps);
  } else {
    if (method.friction == D::Friction::kIsotropic) {
      all.emplace_back("for sliding contacts, solve once without friction to find the direction of slip");
    }
    all.push_back(method.solver == D::Solver::kIterative ? "solve all islands with " + iterations + " iterations of ODE"
                                                         : "solve all islands directly with ODE");
  }
  if (method.rotation == D::Rotation::kExact) {
    all.emplace_back("rotate free bodies by one Runge-Kutta step of Euler's equations");
  }
  all.emplace_back("freeze a body whose state is not finite; publish poses at both ends of the step");
  return all;
}

/// Adds what the steps of the held bodies counted to what those of the others did.
void addCounts(const HeldBodies& held, ObjectState& out) noexcept {
  const ObjectState& counted = held.counted;
  out.held_time = held.time;
  out.too_many_held = held.too_many;
  out.faults |= counted.faults;
  out.stopped_short += counted.stopped_short;
  out.energy.sum += counted.energy.sum;
  out.energy.worst_step = std::max(out.energy.worst_step, counted.energy.worst_step);
  const BodyPenetration &a = out.penetration, &b = counted.penetration;
  const int points = a.points + b.points;
  if (points > 0)
    out.penetration = {points, (a.points * a.mean + b.points * b.mean) / points, std::max(a.worst, b.worst)};
  const std::size_t fingers = std::min(out.finger_impulse_W.size(), counted.finger_impulse_W.size());
  for (std::size_t f = 0; f < fingers; ++f) out.finger_impulse_W[f] += counted.finger_impulse_W[f];
  for (const FingerImpulse& touch : counted.touches) {
    if (FingerImpulse* const added = out.touches.add(touch)) added->until = held.time;
  }
}

std::unique_ptr<Module> create(std::shared_ptr<const World> world, const RunOptions& options) {
  return std::make_unique<DynamicsModule>(std::move(world), options.seed);
}

const ModulePlugin kPlugin{
    .name = "dynamics_ode", .create = create, .library = [] { return std::string("ODE " PRESA_ODE_VERSION); }};

}  // namespace

DynamicsModule::DynamicsModule(std::shared_ptr<const World> world, std::uint64_t seed)
    : Module("dynamics_ode", RateGroup::kDynamics),
      fingers_(*this, "contact_exchange", In<ContactExchange>::Optional{}, WhenOld::kFadeToZero,
               ages::fingers(world->scene.rates)),
      objects_(*this, "object_state"),
      world_(std::move(world)),
      options_(optionsOf(*world_, seed)) {
  objects_.value.bodies.resize(world_->scene.bodies.size());
  FingerImpulses(world_->scene).write(objects_.value);
  if (world_->scene.assembly) snap_constraints_.emplace(*this, "attractions", In<SnapConstraints>::Optional{});
  if (world_->scene.hasForceEffects()) reactions_.emplace(*this, kEffectReactionsPort, In<EffectReactions>::Optional{});
  if (world_->scene.dynamics.coupling == DynamicsSettings::Coupling::kHapticRate) {
    held_.emplace(*this, kHeldBodiesPort, In<HeldBodies>::Optional{});
    released_.resize(world_->scene.bodies.size(), -1);
  }
  if (hasBodyEffects(world_->scene)) body_effects_.emplace(*world_);
  if (needsBodyHits(world_->scene)) {
    hits_.emplace(*this, kBodyHitsPort);
    hits_->value = BodyHits(BodyHits::roomFor(world_->scene.bodies.size()));
  }
}

void DynamicsModule::start() {
  attachThread();
  bodies_ = std::make_unique<OdeWorld>(world_, options_);
  if (body_effects_) bodies_->use(*body_effects_);
  if (hits_) bodies_->listen(hits_->value.room());
  bodies_->makeRoom(fingers_.sized());
  if (reactions_) bodies_->makeRoom(reactions_->sized());
  if (held_) {
    reached_ = held_->sized().refused;
    for (std::size_t i = 0; i < world_->scene.bodies.size(); ++i) bodies_->setReached(i, false);
  }
  bodies_->write(0, objects_.value);
}

void DynamicsModule::setSnapConstraints() noexcept {
  if (!snap_constraints_ || snap_constraints_->version() == snap_constraints_seen_) return;
  snap_constraints_seen_ = snap_constraints_->version();
  bodies_->setSnapConstraints(snap_constraints_->value());
}

// A held body stands where it will be at the end of the step. One that leaves moves on from where it is now.
void DynamicsModule::follow(const HeldBodies& held, const Tick& tick) noexcept {
  constexpr double kOldest = 0.02;  // a body whose pose is older stands still [s]
  const double age = std::clamp(tick.time - held.time, -kOldest, kOldest);  // negative in a late step
  for (const HeldBody& one : held.bodies) {
    const auto body = static_cast<std::size_t>(one.body);
    if (one.phase == HeldBody::Phase::kHeld) {
      bodies_->hold(body, one.poseAfter(age + tick.period), one.v_WB, one.w_WB);
    } else if (one.phase == HeldBody::Phase::kLeaving && released_[body] != one.since) {
      bodies_->hold(body, one.X_WB, one.v_WB, one.w_WB);
      bodies_->release(body, one.poseAfter(age), one.v_WB, one.w_WB);
      released_[body] = one.since;
    }
  }
}

// What a finger touches is moved by the haptic thread from its next tick on: an impulse in this step would be given twice.
void DynamicsModule::leaveFingersTo(const HeldBodies& held) noexcept {
  for (const std::int32_t body : reached_) bodies_->setReached(index(body), false);
  reached_ = held.refused;
  for (const std::int32_t body : reached_) bodies_->setReached(index(body), true);
}

void DynamicsModule::writeHits() noexcept {
  BodyHits& hits = hits_->value;
  const std::uint64_t before = hits.count();
  const auto add = [&](const BodyHit& hit) {
    hits.add(hit);
    return true;
  };
  hits_lost_ += bodies_->hits().read(hits_read_, add);
  if (held_ && held_->hasValue()) hits_lost_ += held_->value().hits.read(held_hits_read_, add);
  if (const std::uint64_t added = hits.count() - before; added > hits.room()) hits_lost_ += added - hits.room();
}

void DynamicsModule::step(const Tick& tick) noexcept {
  setSnapConstraints();
  if (reactions_) bodies_->addReactions(reactions_->value(), tick.period);
  if (held_ && held_->hasValue()) {
    follow(held_->value(), tick);
    leaveFingersTo(held_->value());
  }
  bodies_->step(fingers_.value(), tick.time, tick.period, objects_.value, tick.late);
  if (hits_) writeHits();
  if (held_) bodies_->writeIslands(objects_.value);
  if (held_ && held_->hasValue()) addCounts(held_->value(), objects_.value);
}

void DynamicsModule::stop() {
  bodies_.reset();
  detachThread();
}

std::vector<std::string> DynamicsModule::stages() const {
  std::vector<std::string> stages;
  if (body_effects_) {
    for (const std::string& name : body_effects_->names())
      stages.push_back("body effect " + name + ", implicit in its own damping and stiffness");
  }
  std::ranges::move(listStages(options_), std::back_inserter(stages));
  if (hits_) stages.emplace_back("note the bodies that hit each other, for the effects that hear it");
  return stages;
}

std::vector<std::string> DynamicsModule::notes() const {
  if (hits_lost_ == 0) return {};
  return {std::to_string(hits_lost_) + " hits between bodies were lost: more in a step than there is room for"};
}

std::optional<std::string> DynamicsModule::brokenPlugin() const {
  return body_effects_ ? body_effects_->brokenName() : std::nullopt;
}

}  // namespace presa::ode

PRESA_MODULE_PLUGIN(presa::ode::kPlugin)
