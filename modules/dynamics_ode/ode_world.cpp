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
      : world(std::move(world_)), options(options_), ode(createWorld(world->scene)), space(createSpace()),
        joints(dJointGroupCreate(0)), bodies(std::make_unique<BodySet>(*world, ode, space)), random(options.seed) {
    predicted.resize(bodies->size());
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

  struct ActiveFinger {
    std::size_t finger = 0, body = 0;
    FingerRow row;
  };

  void solveStep(const ContactExchange& exchange, double time, double h);
  void readFingers(const ContactExchange& exchange, double time, double h);
  void predict(double h);
  void addFingerJoint(const ActiveFinger& active);
  void addContactJoint(const BodyContact& contact);
  void applyExplicitForces();
  void integrate(double h);
  void enableOnly(bool large);
  void stepDirect(double h);
  void stepQuick(double h);
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
  std::vector<PredictedMotion> predicted;
  std::vector<ActiveFinger> fingers;
  std::array<dJointFeedback, kMaxFingers> feedback{};
  std::array<Vec3, kMaxFingers> finger_force;
  Faults faults;
  std::uint64_t fallback_steps = 0;
  bool failed = false;
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

void OdeWorld::Impl::predict(double h) {
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    predicted[i] = {};
    if (!bodies->moves(i)) continue;
    const BodyInertiaState inertia = bodies->inertiaState(i);
    Vec3 force = Vec3::Zero(), torque = bodies->gyroscopicTorque(i);
    for (const ActiveFinger& active : fingers) {
      if (active.body != i) continue;
      force += active.row.expected_force_W;
      torque += (active.row.p_WC - inertia.p_WCm).cross(active.row.expected_force_W);
    }
    predicted[i].p_WCm = inertia.p_WCm;
    predicted[i].v_WCm = bodies->centreVelocity(i) + h * (world->scene.gravity + inertia.inverse_mass * force);
    predicted[i].w_WB = bodies->angularVelocity(i) + h * inertia.inverse_inertia_W * torque;
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
  surface.slip1 = row.slip_1;
  surface.slip2 = row.slip_2;
  assign(contact.geom.pos, row.p_WC);
  assign(contact.geom.normal, row.n_in);  // ODE: into the first body attached
  contact.geom.depth = row.depth;
  assign(contact.fdir1, row.t1);
  const dJointID joint = dJointCreateContact(ode, joints, &contact);
  dJointAttach(joint, bodies->body(active.body), nullptr);
  dJointSetFeedback(joint, &feedback[active.finger]);
}

void OdeWorld::Impl::addContactJoint(const BodyContact& c) {
  const auto A = static_cast<std::size_t>(c.A), B = static_cast<std::size_t>(c.B);
  const Scene& scene = world->scene;
  const auto velocity = [&](std::size_t i) -> Vec3 {
    return bodies->moves(i) ? Vec3(bodies->centreVelocity(i) + bodies->angularVelocity(i).cross(c.p_W - predicted[i].p_WCm))
                            : Vec3(Vec3::Zero());
  };
  const Vec3 relative = velocity(B) - velocity(A);
  const double slip_speed = (relative - relative.dot(c.nhat_AB_W) * c.nhat_AB_W).norm();
  dContact contact{};
  dSurfaceParameters& surface = contact.surface;
  surface.mode = dContactSoftERP | dContactSoftCFM | dContactFDir1 | dContactApprox1_1 | dContactApprox1_2;
  surface.mu = pairFriction(scene.materialOf(scene.bodies[A]), scene.materialOf(scene.bodies[B]), slip_speed);
  surface.soft_erp = options.contact_erp;
  surface.soft_cfm = options.contact_cfm;
  assign(contact.geom.pos, c.p_W);
  assign(contact.geom.normal, c.nhat_AB_W);
  contact.geom.depth = c.depth;
  assign(contact.fdir1, slipDirection(c.nhat_AB_W, c.p_W, predicted[A], predicted[B]));
  const dJointID joint = dJointCreateContact(ode, joints, &contact);
  dJointAttach(joint, bodies->body(B), bodies->body(A));
}

void OdeWorld::Impl::applyExplicitForces() {
  for (const ActiveFinger& active : fingers) {
    const Vec3& f = active.row.expected_force_W;
    const Vec3& p = active.row.p_WC;
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

void OdeWorld::Impl::stepQuick(double h) {
  dWorldSetQuickStepNumIterations(ode, options.quick_iterations);
  random.with([&] { dWorldQuickStep(ode, h); });
}

void OdeWorld::Impl::stepDirect(double h) {
  const std::uint64_t messages = messageCount();
  dWorldStep(ode, h);
  if (messageCount() == messages) return;
  ++fallback_steps;
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    if (bodies->moves(i) && dBodyIsEnabled(bodies->body(i)) != 0) bodies->restore(i);
  }
  stepQuick(h);
}

void OdeWorld::Impl::integrate(double h) {
  bool any_small = false, any_large = false;
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    if (bodies->moves(i)) (islands.contacts(i) > options.direct_limit ? any_large : any_small) = true;
  }
  // a disabled body keeps its state and its joints are left out: each solver sees its own islands only
  if (any_small) {
    enableOnly(false);
    stepDirect(h);
  }
  if (any_large) {
    enableOnly(true);
    stepQuick(h);
  }
}

void OdeWorld::Impl::solveStep(const ContactExchange& exchange, double time, double h) {
  bodies->beginStep();
  readFingers(exchange, time, h);
  predict(h);
  collider.find(space, *bodies, contacts);
  islands.reset(bodies->size());
  for (const BodyContact& contact : contacts) {
    const auto A = static_cast<std::size_t>(contact.A), B = static_cast<std::size_t>(contact.B);
    bodies->moves(A) ? islands.join(A, B) : islands.touch(B);
    addContactJoint(contact);
  }
  if (options.coupling == OdeOptions::Coupling::kExplicitForce) {
    applyExplicitForces();
  } else {
    for (const ActiveFinger& active : fingers) {
      islands.touch(active.body);
      addFingerJoint(active);
    }
  }
  integrate(h);
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
