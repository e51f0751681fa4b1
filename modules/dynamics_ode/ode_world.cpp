#include "modules/dynamics_ode/ode_world.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <optional>

#include "framework/geometry/index.h"
#include "modules/dynamics_ode/body_contacts.h"
#include "modules/dynamics_ode/body_effect_forces.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/contact_solver/own_solvers.h"
#include "modules/dynamics_ode/convex/sweep.h"
#include "modules/dynamics_ode/effect_forces.h"
#include "modules/dynamics_ode/energy_book.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/finger_impulses.h"
#include "modules/dynamics_ode/finger_joints.h"
#include "modules/dynamics_ode/hit_finder.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/joints/engine_joints.h"
#include "modules/dynamics_ode/joints/joint_set.h"
#include "modules/dynamics_ode/owed_impulses.h"
#include "modules/dynamics_ode/sleep.h"
#include "modules/dynamics_ode/snap_drive.h"
#include "modules/dynamics_ode/step_solver.h"

namespace presa::ode {
namespace {

constexpr double kSpins = 0.05;  // turn within a period from which a body counts as spinning between fingers [rad]

// Contacts with a gap (negative depth) are not counted.
BodyPenetration penetrationOf(const std::vector<BodyContact>& contacts) noexcept {
  BodyPenetration in{0, 0, 0};
  for (const BodyContact& contact : contacts) {
    if (contact.depth < 0) continue;
    ++in.points;
    in.mean += contact.depth;
    in.worst = std::max(in.worst, contact.depth);
  }
  if (in.points > 0) in.mean /= in.points;
  return in;
}

// Bodies that a joint's motor moves.
std::vector<std::size_t> drivenBodies(const Scene& scene) {
  std::vector<std::size_t> driven;
  const auto moves = [](const JointAxis& axis) { return axis.max_force > 0 && axis.speed != 0; };
  for (const Joint& joint : scene.joints) {
    if (std::ranges::none_of(joint.axes, moves)) continue;
    driven.push_back(joint.body);
    if (joint.to != Joint::kWorld) driven.push_back(joint.to);
  }
  return driven;
}

// For ODE's iterative solver contacts ahead of the touch cost more than they help; Presa's own take all that may meet,
// since in a heap a body can be hit from anywhere.
Foresight foresightOf(const DynamicsSettings& method) {
  if (usesOwnSolvers(method)) return Foresight::kAround;
  return method.solver == DynamicsSettings::Solver::kIterative ? Foresight::kNone : Foresight::kPath;
}

}  // namespace

struct OdeWorld::Impl {
  Impl(std::shared_ptr<const World> world_, const OdeOptions& options_)
      : world(std::move(world_)),
        options(options_),
        engine(world->scene.gravity, options.seed,
               kContactsPerBody * world->scene.bodies.size() + world->scene.devices.size()),
        bodies(*world, options.method.rotation, engine.world()),
        fingers(options.method.coupling, world->scene, engine.world()),
        impulses(world->scene),
        collider(bodies, world->scene.gravity, foresightOf(options.method)),
        islands(bodies.size()),
        energy(engine.gravity(), bodies.size()),
        held(bodies.size()),
        layers(bodies.size()) {
    contacts.reserve(bodies.contactRoom());
    if (usesOwnSolvers(options.method)) {
      own_solvers.emplace(world->scene, engine.gravity(), bodies, options);
      sweep.emplace(bodies);
    } else {
      engine_solvers.emplace(world->scene, engine, bodies, options);
    }
    if (!world->scene.joints.empty()) {
      links.emplace(*world, bodies);
      if (!own_solvers) engine_joints.emplace(*world, bodies, engine.world());
    }
    if (options.method.sleeping) sleep.emplace(bodies, drivenBodies(world->scene));
    if (options.gives_what_is_felt) owed.emplace();
  }

  void step(const ContactExchange& exchange, double time, double period, bool late);
  void pauseFar(const ContactExchange& exchange, double period, bool late);
  void substep(const ContactExchange& exchange, double time, double h, int substeps);
  void pushBodyEffects(double time, double h);
  void wakeStirred(double time, double period);
  void noteBrokenEffect();
  void findIslands(const ContactExchange& exchange);
  std::int32_t islandOf(std::size_t i);
  void wakeTouched(const ContactExchange& exchange);
  bool anyIsland(const std::function<bool(const Islands::Island&)>& is) const;
  int layersThatMatter(int substeps);
  int substepsNow(const ContactExchange& exchange, double period);
  int stepsOfSpin(const ContactExchange& exchange, double period);
  void fault(Faults::Bit bit, std::uint64_t count = 1);
  void giveUp();

  /// Which steps leave out what no finger reaches.
  struct Patience {
    static constexpr int kMaxLate = 1;                   // steps after a whole one that may be late
    static constexpr int kMinWait = 10, kMaxWait = 400;  // steps
    bool leavesOut(bool late, bool held);
    int late_since = 0;      // since the last whole step
    int wait = 0, left = 0;  // steps
    bool was_whole = false;  // the last step that was not late
  } patience;

  std::shared_ptr<const World> world;
  const OdeOptions options;
  Engine engine;
  BodySet bodies;  // declared after the engine, so destroyed before it
  FingerJoints fingers;
  FingerImpulses impulses;
  BodyContacts collider;
  std::optional<OwnSolvers> own_solvers;  // one of these two, as the scene says
  std::optional<StepSolver> engine_solvers;
  std::optional<Sweep> sweep;                 // with Presa's own solvers
  std::optional<Sleep> sleep;                 // empty when the scene turns sleeping off
  std::optional<HitFinder> hits;              // empty unless somebody listens
  std::optional<OwedImpulses> owed;           // empty unless the options ask for it
  std::optional<SnapDrive> snap_drive_;       // empty without an assembly
  std::optional<JointSet> links;              // the joints of the scene; empty without
  std::optional<EngineJoints> engine_joints;  // the same, for the engine's solvers
  EffectForces effects;
  std::optional<BodyEffectForces> body_effects;  // empty when the scene has none
  Islands islands;
  EnergyBook energy;
  std::vector<char> held;  // by island of the last step: a finger touches it
  double far_lag = 0;      // [s]
  Layers layers;
  std::vector<BodyContact> contacts;
  Faults faults;
  std::uint64_t fallback_steps = 0;
  bool failed = false;  // ODE failed: all bodies are frozen
};

void OdeWorld::Impl::fault(Faults::Bit bit, std::uint64_t count) {
  faults.bits |= bit;
  faults.count += count;
}

void OdeWorld::Impl::giveUp() {
  failed = true;
  fault(Faults::kEngineFailed);
  bodies.freezeAll();
  contacts.clear();
  engine.clearContacts();
  impulses.setForcesToZero();
}

void OdeWorld::Impl::findIslands(const ContactExchange& exchange) {
  islands.reset();
  forEachTouch(exchange, bodies,
               [&](std::size_t, const FingerContact&, std::size_t body) { islands.touchByFinger(body); });
  for (const BodyContact& contact : contacts) {
    const std::size_t A = index(contact.A), B = index(contact.B);
    bodies.moves(A) ? islands.join(A, B) : islands.touch(B);
  }
  if (links) links->link(bodies, islands);
}

std::int32_t OdeWorld::Impl::islandOf(std::size_t i) {
  return static_cast<std::int32_t>(bodies.asleep(i) ? sleep->islandOf(i) : islands.of(i));
}

bool OdeWorld::Impl::anyIsland(const std::function<bool(const Islands::Island&)>& is) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (is(islands[i])) return true;
  }
  return false;
}

int OdeWorld::Impl::layersThatMatter(int substeps) {
  if (substeps == 1 || anyIsland([](const Islands::Island& island) { return island.touched; })) return kAllLayers;
  return layers.count(contacts, bodies);
}

int OdeWorld::Impl::stepsOfSpin(const ContactExchange& exchange, double period) {
  double turn = 0;
  std::size_t awake = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) awake += bodies.awake(i) ? 1 : 0;
  if (awake > options.max_spinning) return 1;
  forEachTouch(exchange, bodies, [&](std::size_t, const FingerContact&, std::size_t body) {
    turn = std::max(turn, period * bodies.motion(body).w_WB.norm());
  });
  return turn > kSpins ? std::min(static_cast<int>(std::ceil(turn / options.spin_turn)), options.max_spin_steps) : 1;
}

int OdeWorld::Impl::substepsNow(const ContactExchange& exchange, double period) {
  if (options.method.substeps > 0) return static_cast<int>(options.method.substeps);
  if (own_solvers) return stepsOfSpin(exchange, period);
  const bool iterative = options.method.solver == DynamicsSettings::Solver::kIterative;
  if (!iterative || options.method.coupling != DynamicsSettings::Coupling::kSoft) return 1;
  if (anyIsland([](const Islands::Island& island) { return island.touched; })) return options.large_substeps;
  if (!anyIsland([&](const Islands::Island& island) { return island.contacts > options.large_island; })) return 1;
  // a heap without finger contact gets as many sub-steps as fit
  const int iterations = std::max(options.min_iterations_of_substep, static_cast<int>(options.method.iterations));
  const double visits = static_cast<double>(contacts.size()) * iterations;
  return static_cast<int>(std::clamp(options.iteration_budget / visits, 1.0, double(options.large_substeps)));
}

void OdeWorld::Impl::substep(const ContactExchange& exchange, double time, double h, int substeps) {
  bodies.resetForces();
  if (snap_drive_) snap_drive_->drive(bodies, h);
  effects.push(bodies);
  if (owed) owed->push(bodies);
  if (body_effects) pushBodyEffects(time, h);
  fingers.read(exchange, time, h, bodies);
  if (hits) hits->begin(contacts, bodies);
  if (own_solvers) {
    if (links) links->read(bodies);
    own_solvers->solve(contacts, fingers, snap_drive_ ? &snap_drive_->motors() : nullptr, links ? &*links : nullptr,
                       islands, h);
  } else if (engine_solvers->solve(contacts, fingers, islands, layersThatMatter(substeps), h, substeps)) {
    ++fallback_steps;
  }
  if (hits) hits->end(contacts, bodies, time, h);
  impulses.add(fingers, h, substeps);
  if (owed) owed->notePredicted(fingers, h);
  bodies.driftRotations(h);
  if (sweep) sweep->stopShort(bodies, h);
  energy.settle(bodies, islands, fingers, snap_drive_ ? &snap_drive_->motors() : nullptr, links ? &*links : nullptr);
  if (const std::size_t frozen = bodies.freezeBroken(); frozen > 0) fault(Faults::kBodyFrozen, frozen);
}

void OdeWorld::Impl::pushBodyEffects(double time, double h) {
  body_effects->push(bodies, time, h);
  noteBrokenEffect();
}

void OdeWorld::Impl::wakeStirred(double time, double period) {
  body_effects->wakeStirred(bodies, sleep ? &*sleep : nullptr, time, period);
  noteBrokenEffect();
}

void OdeWorld::Impl::noteBrokenEffect() {
  if (body_effects->broken() && (faults.bits & Faults::kBadEffect) == 0) fault(Faults::kBadEffect);
}

void OdeWorld::Impl::wakeTouched(const ContactExchange& exchange) {
  const std::size_t invalid = forEachTouch(exchange, bodies, [&](std::size_t, const FingerContact&, std::size_t body) {
    if (bodies.asleep(body)) sleep->wake(bodies, body);
  });
  if (invalid > 0) fault(Faults::kBadFinger, invalid);
}

// What people hold is stepped in time; what they do not reach stands still for a step, so that the state of what they
// touch next is fresh, too. Decided by the ticks alone, so that a recording replays to the bit.
void OdeWorld::Impl::pauseFar(const ContactExchange& exchange, double period, bool late) {
  std::fill(held.begin(), held.end(), 0);
  bool any = bodies.anyHeld();  // by the haptic thread, which takes over what they meet
  forEachTouch(exchange, bodies, [&](std::size_t, const FingerContact&, std::size_t body) {
    held[islands.of(body)] = 1;
    any = true;
  });
  if (patience.leavesOut(late, any) && sleep->pauseOthers(bodies, islands, held) > 0) far_lag += period;
}

// A whole step after which many are late takes too long for what is held: the next one waits, twice as long each time.
bool OdeWorld::Impl::Patience::leavesOut(bool late, bool held) {
  if (late) {
    ++late_since;
    return true;
  }
  if (held && left > 0 && --left > 0) return true;
  if (was_whole) {
    wait = late_since > kMaxLate ? std::min(2 * std::max(wait, kMinWait), kMaxWait) : 0;
    left = wait;
  }
  if (!held) left = 0;
  was_whole = left == 0;
  late_since = 0;
  return !was_whole;
}

void OdeWorld::Impl::step(const ContactExchange& exchange, double time, double period, bool late) {
  impulses.makeRoom(exchange.fingers.size());
  if (sleep) sleep->resume(bodies);
  if (sleep) pauseFar(exchange, period, late);
  impulses.begin(time);
  wakeTouched(exchange);
  if (owed) {
    owed->read(exchange, period, bodies);
    impulses.add(*owed, period);
  }
  if (snap_drive_) snap_drive_->carry(bodies, sleep ? &*sleep : nullptr, period);
  if (body_effects) wakeStirred(time, period);
  if (!bodies.anyAwake()) {
    contacts.clear();
    if (links) links->read(bodies);  // a held body turns on
    return impulses.end();
  }
  int substeps = 1;
  for (int s = 0; s < substeps; ++s) {
    bodies.beginStep();
    collider.find(bodies, period / substeps + options.look_ahead, contacts,
                  [&](std::size_t i) { sleep->wake(bodies, i); });
    findIslands(exchange);
    if (s == 0) substeps = substepsNow(exchange, period);
    substep(exchange, time + s * period / substeps, period / substeps, substeps);
  }
  impulses.end();
  if (sleep) sleep->afterStep(bodies, islands, period);
}

OdeWorld::OdeWorld(std::shared_ptr<const World> world, const OdeOptions& options)
    : impl_(std::make_unique<Impl>(std::move(world), options)) {}

OdeWorld::~OdeWorld() = default;

void OdeWorld::step(const ContactExchange& fingers, double time, double period, bool late) noexcept {
  Impl& impl = *impl_;
  if (impl.failed) return;
  try {
    impl.step(fingers, time, period, late);
  } catch (const std::exception&) {
    impl.giveUp();
  }
}

void OdeWorld::step(const ContactExchange& fingers, double time, double period, ObjectState& out, bool late) noexcept {
  step(fingers, time, period, late);
  write(time, out);
  out.time_end = time + period;
}

void OdeWorld::hold(std::size_t i, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB) noexcept {
  BodySet& bodies = impl_->bodies;
  if (bodies.asleep(i)) impl_->sleep->wake(bodies, i);
  if (bodies.moves(i) || bodies.isHeld(i)) bodies.hold(i, X_WB, v_WB, w_WB);
}

void OdeWorld::release(std::size_t i, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB) noexcept {
  if (impl_->bodies.isHeld(i)) impl_->bodies.release(i, X_WB, v_WB, w_WB);
}

void OdeWorld::setReached(std::size_t i, bool reached) noexcept { impl_->bodies.setReached(i, reached); }

void OdeWorld::setSnapConstraints(const SnapConstraints& snap_constraints) {
  if (impl_->failed) return;
  if (!impl_->snap_drive_) impl_->snap_drive_.emplace(impl_->bodies, impl_->engine.world());
  impl_->snap_drive_->read(snap_constraints, impl_->bodies, impl_->sleep ? &*impl_->sleep : nullptr);
}

void OdeWorld::makeRoom(const ContactExchange& fingers) {
  impl_->fingers.makeRoom(fingers);
  impl_->impulses.makeRoom(fingers.fingers.size());
  if (impl_->owed) impl_->owed->makeRoom(fingers);
  if (impl_->own_solvers) {
    impl_->own_solvers->makeRoom(std::max(fingers.fingers.size(), fingers.contacts.capacity()),
                                 impl_->world->scene.joints.size());
  }
}

void OdeWorld::makeRoom(const EffectReactions& reactions) { impl_->effects.makeRoom(reactions.bodies.size()); }

void OdeWorld::use(BodyEffects& effects) { impl_->body_effects.emplace(effects, *impl_->world); }

void OdeWorld::listen(std::size_t room) { impl_->hits.emplace(room, impl_->bodies.contactRoom()); }

const BodyHits& OdeWorld::hits() const noexcept {
  static const BodyHits kNone;
  return impl_->hits ? impl_->hits->hits() : kNone;
}

void OdeWorld::addReactions(const EffectReactions& reactions, double period) noexcept {
  if (!impl_->failed) impl_->effects.read(reactions, period, impl_->bodies, impl_->sleep ? &*impl_->sleep : nullptr);
}

void OdeWorld::write(double time, ObjectState& out) noexcept {
  impl_->bodies.write(out);
  out.time_begin = out.time_end = time;
  writeCounts(out);
}

void OdeWorld::writeIslands(ObjectState& out) const noexcept {
  for (std::size_t i = 0; i < out.bodies.size(); ++i) out.bodies[i].island = impl_->islandOf(i);
}

void OdeWorld::writeCounts(ObjectState& out) const noexcept {
  out.faults = impl_->faults.bits;
  out.fallback_steps = impl_->fallback_steps;
  out.penetration = penetrationOf(impl_->contacts);
  out.energy = {impl_->energy.created(), impl_->energy.worstStep()};
  out.far_lag = impl_->far_lag;
  if (impl_->sweep) out.stopped_short = impl_->sweep->stops();
  impl_->impulses.write(out);
  if (impl_->owed) impl_->owed->leaveOutPredicted(out.touches);
}

BodyMotion OdeWorld::motion(std::size_t i) const noexcept { return impl_->bodies.now(i); }

void OdeWorld::setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB) noexcept {
  if (impl_->bodies.asleep(i)) impl_->sleep->wake(impl_->bodies, i);
  impl_->bodies.setVelocity(i, v_WB, w_WB);
}

Vec3 OdeWorld::fingerForce(std::size_t i) const noexcept { return impl_->impulses.force(i); }
const std::vector<BodyContact>& OdeWorld::contacts() const noexcept { return impl_->contacts; }
const Faults& OdeWorld::faults() const noexcept { return impl_->faults; }
std::uint64_t OdeWorld::fallbackSteps() const noexcept { return impl_->fallback_steps; }

}  // namespace presa::ode
