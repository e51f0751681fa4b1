#include "modules/dynamics_ode/engine.h"

#include <mutex>

#include "modules/dynamics_ode/ode_runtime.h"

namespace presa::ode {
namespace {

// far below any compliance that matters, enough to keep redundant rows solvable
constexpr double kWorldCfm = 1e-10;

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

dSpaceID createSpace() {
  const dSpaceID space = dHashSpaceCreate(nullptr);
  dHashSpaceSetLevels(space, -10, 6);  // cells from 1 mm to 64 m
  return space;
}

}  // namespace

Engine::Engine(const Vec3& gravity, std::uint64_t seed)
    : world_(createWorld(gravity)),
      space_(createSpace()),
      contacts_(dJointGroupCreate(0)),
      random_state_(static_cast<unsigned long>(seed)) {}

Engine::~Engine() {
  dJointGroupDestroy(contacts_);
  dSpaceDestroy(space_);
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
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  dRandSetSeed(random_state_);
  dWorldQuickStep(world_, h);
  random_state_ = dRandGetSeed();
}

}  // namespace presa::ode
