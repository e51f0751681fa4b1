#include "modules/dynamics_ode/engine.h"

#include <atomic>

#include "framework/state/limits.h"
#include "modules/dynamics_ode/ode_runtime.h"

namespace presa::ode {
namespace {

// far below any compliance that matters, enough to keep redundant rows solvable
constexpr double kWorldCfm = 1e-10;
constexpr dContact kAnyContact{};

dWorldID createWorld(const Vec3& gravity) {
  attachThread();
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, gravity.x(), gravity.y(), gravity.z());
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

// Worlds on several threads (tests, studies) take turns. Without a rival it is one exchange: no call, no lock.
class OneAtATime {
 public:
  OneAtATime() {
    while (taken.test_and_set(std::memory_order_acquire)) taken.wait(true);
  }
  ~OneAtATime() {
    taken.clear(std::memory_order_release);
    taken.notify_one();
  }
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;

 private:
  static constinit std::atomic_flag taken;
};
constinit std::atomic_flag OneAtATime::taken;

}  // namespace

Engine::Engine(const Vec3& gravity, std::uint64_t seed, std::size_t contacts)
    : world_(createWorld(gravity)), contacts_(dJointGroupCreate(0)), random_state_(static_cast<unsigned long>(seed)) {
  takeMemory(contacts + kMaxFingers);
}

// What ODE has had once it keeps: joints in their group, working memory and jobs of either solver.
void Engine::takeMemory(std::size_t joints) {
  for (std::size_t i = 0; i < joints; ++i) dJointCreateContact(world_, contacts_, &kAnyContact);
  clearContacts();
  const dBodyID body = dBodyCreate(world_);
  solveDirectly(1e-3);
  solveIteratively(1e-3, 1);
  dBodyDestroy(body);
}

Engine::~Engine() {
  dJointGroupDestroy(contacts_);
  dWorldDestroy(world_);
}

void Engine::addContact(const dContact& contact, dBodyID first, dBodyID second, dJointFeedback* feedback) {
  const dJointID joint = dJointCreateContact(world_, contacts_, &contact);
  dJointAttach(joint, first, second);
  dJointSetFeedback(joint, feedback);
}

void Engine::clearContacts() { dJointGroupEmpty(contacts_); }

bool Engine::solveDirectly(double h) {
  const std::uint64_t messages = messageCount();
  dWorldStep(world_, h);
  return messageCount() == messages;
}

void Engine::solveIteratively(double h, int iterations) {
  dWorldSetQuickStepNumIterations(world_, iterations);
  // ODE's random numbers are one global stream: each world takes its own up where it left it
  const OneAtATime turn;
  dRandSetSeed(random_state_);
  dWorldQuickStep(world_, h);
  random_state_ = dRandGetSeed();
}

}  // namespace presa::ode
