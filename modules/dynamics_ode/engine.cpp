#include "modules/dynamics_ode/engine.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <mutex>

#include "framework/core/state/limits.h"
#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {
namespace {

// ODE's handlers are global, but a world belongs to one thread: per-thread counters keep the worlds apart
thread_local std::uint64_t message_count = 0;
thread_local bool attached = false;

void countMessage(int, const char*, va_list) { ++message_count; }

// ODE ends the process when this handler returns, so it throws
[[noreturn]] void raiseFailure(int, const char* format, va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  throw OdeFailure(text.data());
}

void startOnce() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetMessageHandler(countMessage);
    dSetDebugHandler(raiseFailure);
    dSetErrorHandler(raiseFailure);
  });
  if (dCheckConfiguration("ODE_double_precision") != 1) {
    throw std::runtime_error(
        "the installed Open Dynamics Engine is a single-precision build; Presa needs libode in double precision");
  }
}

}  // namespace

void attachThread() {
  startOnce();
  if (attached) return;
  if (dAllocateODEDataForThread(dAllocateMaskAll) == 0) throw std::runtime_error("ODE: no memory for this thread");
  attached = true;
}

void detachThread() {
  if (attached) dCleanupODEAllDataForThread();
  attached = false;
}

std::uint64_t messageCount() noexcept { return message_count; }

namespace {

// far below any relevant compliance, but enough to keep redundant rows solvable
constexpr double kWorldCfm = 1e-10;
constexpr std::size_t kJointsPerGroup = 1024;  // ODE allocates memory when it empties a larger group
// working memory of the direct solver at its limit, and of the iterative one [bytes]
constexpr std::size_t kWorkingMemory = 2U << 20U, kWorkingMemoryPerContact = 2048;

dWorldID createWorld(const Vec3& gravity, std::size_t contacts) {
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
  reserve.reserve_minimum = static_cast<unsigned>(kWorkingMemory + contacts * kWorkingMemoryPerContact);
  dWorldSetStepMemoryReservationPolicy(world, &reserve);
  return world;
}

// Serialises worlds on several threads (tests, studies). Uncontended it is one atomic exchange: no system call, no
// lock.
class OneAtATime {
 public:
  explicit OneAtATime(std::atomic_flag& taken) : taken_(taken) {
    while (taken_.test_and_set(std::memory_order_acquire)) taken_.wait(true);
  }
  ~OneAtATime() {
    taken_.clear(std::memory_order_release);
    taken_.notify_one();
  }
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;

 private:
  std::atomic_flag& taken_;
};
constinit std::atomic_flag random_numbers_taken, mesh_cache_taken;

bool isMesh(dGeomID geom) { return dGeomGetClass(geom) == dTriMeshClass; }

}  // namespace

int collide(dGeomID one, dGeomID other, int most, dContactGeom* contacts) {
  if (!isMesh(one) && !isMesh(other)) return dCollide(one, other, most, contacts, sizeof(dContactGeom));
  // the installed ODE collides all meshes of the process in one cache, whatever their threads
  const OneAtATime turn(mesh_cache_taken);
  return dCollide(one, other, most, contacts, sizeof(dContactGeom));
}

Engine::Engine(const Vec3& gravity, std::uint64_t seed, std::size_t contacts)
    : world_(createWorld(gravity, contacts)),
      jobs_(dThreadingAllocateSelfThreadedImplementation()),
      random_state_(static_cast<unsigned long>(seed)) {
  if (!jobs_) throw std::runtime_error("ODE: no memory for the jobs of a world");
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(jobs_.get()), jobs_.get());
  for (std::size_t joints = 0; joints < contacts; joints += kJointsPerGroup) groups_.push_back(dJointGroupCreate(0));
  takeMemory(contacts);
}

// Makes ODE allocate in advance the memory that it keeps: joints in their groups, working memory and jobs of both
// solvers.
void Engine::takeMemory(std::size_t joints) {
  for (std::size_t i = 0; i < joints; ++i) createContact({});
  clearContacts();
  const dBodyID body = dBodyCreate(world_);
  solveDirectly(1e-3);
  solveIteratively(1e-3, 1);
  dBodyDestroy(body);
}

Vec3 Engine::gravity() const noexcept {
  dVector3 gravity;
  dWorldGetGravity(world_, gravity);
  return toVec3(gravity);
}

Engine::~Engine() {
  for (const dJointGroupID group : groups_) dJointGroupDestroy(group);
  dWorldDestroy(world_);
}

dJointID Engine::createContact(const dContact& contact) {
  const std::size_t group = std::min(joints_++ / kJointsPerGroup, groups_.size() - 1);
  return dJointCreateContact(world_, groups_[group], &contact);
}

void Engine::addContact(const dContact& contact, dBodyID first, dBodyID second, dJointFeedback* feedback) {
  const dJointID joint = createContact(contact);
  dJointAttach(joint, first, second);
  dJointSetFeedback(joint, feedback);
}

void Engine::clearContacts() {
  for (const dJointGroupID group : groups_) dJointGroupEmpty(group);
  joints_ = 0;
}

bool Engine::solveDirectly(double h) {
  const std::uint64_t messages = messageCount();
  dWorldStep(world_, h);
  return messageCount() == messages;
}

void Engine::solveIteratively(double h, int iterations) {
  dWorldSetQuickStepNumIterations(world_, iterations);
  // ODE's random numbers are one global stream: each world saves and restores its own state
  const OneAtATime turn(random_numbers_taken);
  dRandSetSeed(random_state_);
  dWorldQuickStep(world_, h);
  random_state_ = dRandGetSeed();
}

}  // namespace presa::ode
