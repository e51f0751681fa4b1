#include "modules/dynamics_ode/ode_world.h"

#include <algorithm>
#include <mutex>

#include "modules/dynamics_ode/body_contacts.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/finger_row.h"
#include "modules/dynamics_ode/friction.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/ode_runtime.h"
#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {
namespace {

// far below any compliance that matters, enough to keep redundant rows solvable
constexpr double kWorldCfm = 1e-10;
// enough for a direction
constexpr int kPredictionIterations = 20;

dWorldID createWorld(const Scene& scene) {
  attachThread();
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
  dWorldSetCFM(world, kWorldCfm);
  dWorldSetContactSurfaceLayer(world, 0);
  dWorldSetContactMaxCorrectingVel(world, dInfinity);
  dWorldSetAutoDisableFlag(world, 0);
  dWorldStepReserveInfo reserve{};
  reserve.struct_size = sizeof(reserve);
  reserve.reserve_factor = 1.5F;
  reserve.reserve_minimum = 1U << 20U;
  dWorldSetStepMemoryReservationPolicy(world, &reserve);
  return world;
}

dSpaceID createSpace() {
  const dSpaceID space = dHashSpaceCreate(nullptr);
  dHashSpaceSetLevels(space, -10, 6);  // cells from 1 mm to 64 m
  return space;
}

// ODE's random numbers are one global stream: each world takes its own up where it left it
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(static_cast<unsigned long>(seed)) {}
  template <class Solve>
  void with(Solve solve) {
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    dRandSetSeed(state_);
    solve();
    state_ = dRandGetSeed();
  }

 private:
  unsigned long state_;
};

}  // namespace

struct OdeWorld::Impl {
  Impl(std::shared_ptr<const World> world_, const OdeOptions& options_)
      : world(std::move(world_)),
        options(options_),
        ode(createWorld(world->scene)),
        space(createSpace()),
        joints(dJointGroupCreate(0)),
        bodies(std::make_unique<BodySet>(*world, ode, space)),
        random(options.seed) {
    motions.resize(bodies->size());
    contacts.reserve(4 * bodies->size());
  }
  ~Impl() {
    bodies.reset();
    dJointGroupDestroy(joints);
    dSpaceDestroy(space);
    dWorldDestroy(ode);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  struct ContactSurface {
    double cfm = 0, mu = 0;
    Vec3 direction = Vec3::UnitX();
  };
  struct ActiveFinger {
    std::size_t finger = 0, body = 0;
    FingerRow row;
  };

  void solveStep(const ContactExchange& exchange, double time, double h);
  void readFingers(const ContactExchange& exchange, double time, double h);
  void countIslands();
  void readMotions(bool start);
  void chooseFriction(double h);
  void addFingerJoint(const ActiveFinger& active);
  void addFingerJoints();
  void addContactJoint(const BodyContact& contact, const ContactSurface& surface);
  int quickIterations() const;
  void applyExplicitForces();
  void integrate(double h, int iterations);
  void enableOnly(bool large);
  void stepDirect(double h, int iterations);
  void stepQuick(double h, int iterations);
  void fault(Faults::Bit bit, std::uint64_t count = 1);

  std::shared_ptr<const World> world;
  OdeOptions options;
  dWorldID ode;
  dSpaceID space;
  dJointGroupID joints;
  std::unique_ptr<BodySet> bodies;
  RandomStream random;
  BodyContacts collider;
  Islands islands;
  std::vector<BodyContact> contacts;
  std::vector<ContactSurface> surfaces;  // as contacts
  std::vector<Motion> motions;           // as bodies
  std::vector<ActiveFinger> fingers;
  std::array<dJointFeedback, kMaxFingers> feedback{};
  std::array<Vec3, kMaxFingers> finger_force;
  Faults faults;
  std::uint64_t fallback_steps = 0;
  bool solver_failed = false;  // the direct solver, in this step
  bool failed = false;         // ODE itself: nothing moves any more
};

void OdeWorld::Impl::fault(Faults::Bit bit, std::uint64_t count) {
  faults.bits |= bit;
  faults.count += count;
}

void OdeWorld::Impl::readFingers(const ContactExchange& exchange, double time, double h) {
  fingers.clear();
  finger_force.fill(Vec3::Zero());
  const auto count = static_cast<std::size_t>(std::clamp(exchange.count, 0, kMaxFingers));
  for (std::size_t f = 0; f < count; ++f) {
    const FingerContact& contact = exchange.fingers[f];
    if (contact.mode == ContactMode::kNone) continue;
    const auto body = static_cast<std::size_t>(contact.body);
    if (contact.body < 0 || body >= bodies->size() || !isUsable(contact)) {
      fault(Faults::kBadFinger);
      continue;
    }
    if (!bodies->moves(body)) continue;
    const auto row = makeFingerRow(contact, bodies->inertiaState(body), time - exchange.time, h);
    if (row) fingers.push_back({f, body, *row});
  }
}

void OdeWorld::Impl::addFingerJoint(const ActiveFinger& active) {
  const FingerRow& row = active.row;
  dContact contact{};
  dSurfaceParameters& surface = contact.surface;
  surface.mode = dContactSoftERP | dContactSoftCFM | dContactMotionN | dContactFDir1 | dContactMotion1 |
                 dContactMotion2 | dContactSlip1 | dContactSlip2 | dContactApprox1_1 | dContactApprox1_2;
  surface.mu = row.mu;
  surface.soft_erp = row.erp;
  surface.soft_cfm = row.cfm;
  surface.motionN = row.motion_n;
  surface.motion1 = row.motion_1;
  surface.motion2 = row.motion_2;
  surface.slip1 = row.slip;
  surface.slip2 = row.slip;
  assign(contact.geom.pos, row.p_WP);
  assign(contact.geom.normal, row.n_in);  // ODE: into the first body attached
  contact.geom.depth = row.depth;
  assign(contact.fdir1, row.t1);
  const dJointID joint = dJointCreateContact(ode, joints, &contact);
  dJointAttach(joint, bodies->body(active.body), nullptr);
  dJointSetFeedback(joint, &feedback[active.finger]);
}

void OdeWorld::Impl::addContactJoint(const BodyContact& c, const ContactSurface& s) {
  dContact contact{};
  dSurfaceParameters& surface = contact.surface;
  surface.mode = dContactSoftERP | dContactSoftCFM | dContactFDir1 | dContactApprox1_1 | dContactApprox1_2;
  surface.mu = s.mu;
  surface.soft_erp = options.contact_erp;
  surface.soft_cfm = s.cfm;
  assign(contact.geom.pos, c.p_W);
  assign(contact.geom.normal, c.nhat_AB_W);
  contact.geom.depth = c.depth;
  assign(contact.fdir1, s.direction);
  const dJointID joint = dJointCreateContact(ode, joints, &contact);
  dJointAttach(joint, bodies->body(static_cast<std::size_t>(c.B)), bodies->body(static_cast<std::size_t>(c.A)));
}

void OdeWorld::Impl::addFingerJoints() {
  if (options.coupling == OdeOptions::Coupling::kExplicitForce) return;
  for (const ActiveFinger& active : fingers) addFingerJoint(active);
}

// Before each call of a solver: ODE forgets forces with every step, and those of disabled bodies must wait.
void OdeWorld::Impl::applyExplicitForces() {
  if (options.coupling == OdeOptions::Coupling::kSoftContact) return;
  for (const ActiveFinger& active : fingers) {
    const Vec3& f = active.row.expected_force_W;
    const Vec3& p = active.row.p_WP;
    if (dBodyIsEnabled(bodies->body(active.body)) == 0) continue;
    dBodyAddForceAtPos(bodies->body(active.body), f.x(), f.y(), f.z(), p.x(), p.y(), p.z());
  }
}

void OdeWorld::Impl::enableOnly(bool large) {
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    if (!bodies->moves(i)) continue;
    const bool is_large = islands.contacts(i) > options.direct_limit;
    if (is_large == large) {
      dBodyEnable(bodies->body(i));
    } else {
      dBodyDisable(bodies->body(i));
    }
  }
}

void OdeWorld::Impl::stepQuick(double h, int iterations) {
  applyExplicitForces();
  dWorldSetQuickStepNumIterations(ode, iterations);
  random.with([&] { dWorldQuickStep(ode, h); });
}

void OdeWorld::Impl::stepDirect(double h, int iterations) {
  const std::uint64_t messages = messageCount();
  applyExplicitForces();
  dWorldStep(ode, h);
  if (messageCount() == messages) return;
  solver_failed = true;
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    if (bodies->moves(i) && dBodyIsEnabled(bodies->body(i)) != 0) bodies->restore(i);
  }
  stepQuick(h, iterations);
}

void OdeWorld::Impl::integrate(double h, int iterations) {
  bool any_small = false, any_large = false;
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    if (bodies->moves(i)) (islands.contacts(i) > options.direct_limit ? any_large : any_small) = true;
  }
  // a disabled body keeps its state and its joints are left out: each solver sees its own islands only
  if (any_small) {
    enableOnly(false);
    stepDirect(h, iterations);
  }
  if (any_large) {
    enableOnly(true);
    stepQuick(h, iterations);
  }
}

int OdeWorld::Impl::quickIterations() const {
  const int affordable = options.quick_budget / std::max(1, static_cast<int>(contacts.size()));
  return std::min(options.quick_iterations, std::max(options.min_quick_iterations, affordable));
}

void OdeWorld::Impl::countIslands() {
  islands.reset(bodies->size());
  for (const BodyContact& contact : contacts) {
    const auto A = static_cast<std::size_t>(contact.A), B = static_cast<std::size_t>(contact.B);
    bodies->moves(A) ? islands.join(A, B) : islands.touch(B);
  }
  for (const ActiveFinger& active : fingers) islands.touch(active.body);
}

// `start`: the bodies are where the step began; otherwise only their velocities are taken
void OdeWorld::Impl::readMotions(bool start) {
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    if (start) motions[i].p_WCm = bodies->moves(i) ? bodies->inertiaState(i).p_WCm : Vec3(Vec3::Zero());
    motions[i].v_WCm = bodies->centreVelocity(i);
    motions[i].w_WB = bodies->angularVelocity(i);
  }
}

// Friction must point along the slip that the end of the step would see without it, and that depends on all that acts
// on the bodies, their supports included. So the step is solved once without friction between bodies (a third of the
// rows), the slip read, and everything put back.
void OdeWorld::Impl::chooseFriction(double h) {
  surfaces.resize(contacts.size());
  readMotions(true);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const BodyContact& c = contacts[i];
    const auto A = static_cast<std::size_t>(c.A), B = static_cast<std::size_t>(c.B);
    const double slip_speed = slipVelocity(c.nhat_AB_W, c.p_W, motions[A], motions[B]).norm();
    const Scene& scene = world->scene;
    const double cfm = h * options.contact_softness * (bodies->inverseMass(A) + bodies->inverseMass(B));
    surfaces[i] = {std::min(cfm, options.max_contact_cfm), 0, c.nhat_AB_W.unitOrthogonal()};
    addContactJoint(c, surfaces[i]);
    surfaces[i].mu = pairFriction(scene.materialOf(scene.bodies[A]), scene.materialOf(scene.bodies[B]), slip_speed);
  }
  addFingerJoints();
  integrate(h, std::min(quickIterations(), kPredictionIterations));
  dJointGroupEmpty(joints);
  readMotions(false);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const BodyContact& c = contacts[i];
    const Vec3 slip = slipVelocity(c.nhat_AB_W, c.p_W, motions[static_cast<std::size_t>(c.A)],
                                   motions[static_cast<std::size_t>(c.B)]);
    surfaces[i].direction = frictionDirection(c.nhat_AB_W, slip);
  }
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    if (bodies->moves(i)) bodies->restore(i);
  }
}

void OdeWorld::Impl::solveStep(const ContactExchange& exchange, double time, double h) {
  bodies->beginStep();
  readFingers(exchange, time, h);
  collider.find(space, *bodies, contacts);
  countIslands();
  if (!contacts.empty()) chooseFriction(h);
  solver_failed = false;  // a look ahead that failed costs a direction only
  for (std::size_t i = 0; i < contacts.size(); ++i) addContactJoint(contacts[i], surfaces[i]);
  addFingerJoints();
  integrate(h, quickIterations());
  if (solver_failed) ++fallback_steps;
  for (const ActiveFinger& active : fingers) {
    finger_force[active.finger] = options.coupling == OdeOptions::Coupling::kExplicitForce
                                      ? active.row.expected_force_W
                                      : toVec3(feedback[active.finger].f1);
  }
  bodies->driftRotations(h);
  if (const std::size_t frozen = bodies->freezeBroken(); frozen > 0) fault(Faults::kBodyFrozen, frozen);
}

OdeWorld::OdeWorld(std::shared_ptr<const World> world, const OdeOptions& options)
    : impl_(std::make_unique<Impl>(std::move(world), options)) {}

OdeWorld::~OdeWorld() = default;

void OdeWorld::step(const ContactExchange& fingers, double time, double period, ObjectState& out) noexcept {
  Impl& impl = *impl_;
  if (!impl.failed) {
    try {
      impl.solveStep(fingers, time, period);
    } catch (const std::exception&) {
      impl.failed = true;
      impl.fault(Faults::kEngineFailed);
      impl.bodies->freezeAll();
      impl.contacts.clear();
      impl.finger_force.fill(Vec3::Zero());
    }
    dJointGroupEmpty(impl.joints);
  }
  impl.bodies->write(out);
  out.time_begin = time;
  out.time_end = time + period;
}

void OdeWorld::write(double time, ObjectState& out) noexcept {
  impl_->bodies->write(out);
  out.time_begin = out.time_end = time;
}

void OdeWorld::setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB) noexcept {
  impl_->bodies->setVelocity(i, v_WB, w_WB);
}

Vec3 OdeWorld::fingerForce(std::size_t i) const noexcept { return impl_->finger_force[i]; }
const std::vector<BodyContact>& OdeWorld::contacts() const noexcept { return impl_->contacts; }
const Faults& OdeWorld::faults() const noexcept { return impl_->faults; }
std::uint64_t OdeWorld::fallbackSteps() const noexcept { return impl_->fallback_steps; }

}  // namespace presa::ode
